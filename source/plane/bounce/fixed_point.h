// Anderson acceleration of a linear fixed-point iteration x <- g(x): in the span of the last steps, the next x is the place with the
// shortest step. D. G. Anderson, Iterative procedures for nonlinear integral equations, J. ACM 12 (1965).
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace steradian::plane {

class FixedPoint {
 public:
  explicit FixedPoint(std::size_t size) : size_(size) {}

  // x: the argument of g; g: its result, which becomes the next x.
  void improve(std::span<const double> x, std::span<double> g) {
    Pair now{std::vector<double>(size_), std::vector<double>(g.begin(), g.end())};
    for (std::size_t i = 0; i < size_; ++i) now.step[i] = g[i] - x[i];
    if (!last_.step.empty()) {
      Pair change = now;
      add(change, last_, -1);
      // The differences of steps are kept orthonormal; those of results follow them.
      for (const Pair& other : changes_) add(change, other, -product(change.step, other.step));
      const double norm = std::sqrt(product(change.step, change.step));
      if (norm > 0) {
        for (auto* values : {&change.step, &change.answer})
          for (double& v : *values) v /= norm;
        if (changes_.size() == kKept) changes_.erase(changes_.begin());
        changes_.push_back(std::move(change));
      }
    }
    last_ = now;
    for (const Pair& change : changes_) {
      const double along = product(now.step, change.step);
      for (std::size_t i = 0; i < size_; ++i) g[i] -= along * change.answer[i];
    }
  }

 private:
  static constexpr std::size_t kKept = 8;
  struct Pair {
    std::vector<double> step, answer;
  };
  double product(const std::vector<double>& a, const std::vector<double>& b) const {
    double sums[4] = {};
    std::size_t i = 0;
    for (; i + 4 <= size_; i += 4)
      for (std::size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
    for (; i < size_; ++i) sums[0] += a[i] * b[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
  void add(Pair& to, const Pair& other, double factor) const {
    for (std::size_t i = 0; i < size_; ++i) to.step[i] += factor * other.step[i], to.answer[i] += factor * other.answer[i];
  }
  std::size_t size_;
  Pair last_;
  std::vector<Pair> changes_;
};

}  // namespace steradian::plane
