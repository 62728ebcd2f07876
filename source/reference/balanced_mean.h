// BalancedMean: the mean of samples of several densities by the balance heuristic, and its variance.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "steradian/vector.h"

namespace steradian::reference {

// Estimates an integral by rounds of one sample of each density. The variance of the rounds alone is wrong where a density meets the
// integrand so rarely that no sample has met it yet: a lobe that is sampled for a line of light. But samples of the other densities know
// how often that happens. Here g is the integrand over the sum of all densities, and the balance heuristic sums g over a round. So
//
//   variance of a round = integral of g^2 sum_s p_s - sum_s (integral of g p_s)^2.
//
// Samples of all densities estimate both integrals. Where too few samples of one density meet the integrand, this variance is too large,
// and that of the rounds is too small by as much: a density that finds the fraction e of a constant g gives 2 e - e' and e' for the e' that
// it has found. So their mean is no longer off on average. But a batch that has found too much is further off than others: for a single
// answer, the larger of both is the honest one.
class BalancedMean {
 public:
  explicit BalancedMean(std::size_t densities) : parts_(densities) {}

  // A sample of any density: g, and all densities there.
  void add(Vec3d g, std::span<const double> densities) {
    double sum = 0;
    for (const double density : densities) sum += density;
    if (!(sum > 0)) return;
    round_ += g;
    squares_ += g * g;
    for (std::size_t s = 0; s < parts_.size(); ++s) parts_[s] += g * (densities[s] / sum);
  }

  // After each round. Source: Welford 1962.
  void end_round() {
    const Vec3d delta = round_ - mean_;
    mean_ += delta / static_cast<double>(++count_);
    deviations_ += delta * (round_ - mean_);
    round_ = {};
  }

  Vec3d mean() const { return mean_; }

  // Variance of the mean, true on average: for sums of many estimates.
  Vec3d variance() const {
    return combined([](double a, double b) { return std::max(0.5 * (a + b), 0.0); });
  }
  // The larger of both, for a single estimate.
  Vec3d larger_variance() const {
    return combined([](double a, double b) { return std::max({a, b, 0.0}); });
  }

 private:
  // That of one round alone is by the densities only.
  template <class Join>
  Vec3d combined(Join join) const {
    if (count_ == 0) return {};
    const auto n = static_cast<double>(count_);
    Vec3d by_densities = squares_ / n;
    for (const Vec3d& part : parts_) by_densities -= (part / n) * (part / n);
    const Vec3d by_rounds = count_ > 1 ? deviations_ / n : by_densities;
    return Vec3d{join(by_densities.x, by_rounds.x), join(by_densities.y, by_rounds.y), join(by_densities.z, by_rounds.z)} /
           std::max(n - 1, 1.0);
  }

  int count_ = 0;
  Vec3d round_{}, mean_{}, deviations_{}, squares_{};
  std::vector<Vec3d> parts_;  // by density: sum of its parts of g
};

}  // namespace steradian::reference
