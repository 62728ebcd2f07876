#include "integrals/textured/profile_table.h"

#include <cmath>
#include <numbers>

namespace steradian {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Equal steps of the horizontal angle that meet all of a profile's; 0: there are none, or too many.
int columns_of(const LightProfile& profile) {
  if (profile.type != LightProfile::Type::c || profile.candela.empty()) return 0;
  const std::vector<double>& angles = profile.horizontal;
  if (angles.size() == 1) return 1;
  if (angles.front() != 0 || angles.back() != 360) return 0;
  for (int n = 2; n <= ProfileTable::kMostColumns; ++n) {
    const auto fits = [&](double angle) { return std::fabs(angle * n / 360 - std::round(angle * n / 360)) < 1e-9; };
    if (std::all_of(angles.begin(), angles.end(), fits)) return n;
  }
  return 0;
}

}  // namespace

ProfileTable::ProfileTable(const LightProfile& profile) : columns_(columns_of(profile)) {
  if (!serves()) return;
  const double widest = profile.vertical.back() * kRadiansPerDegree;
  last_ = static_cast<float>(std::sin(widest / 2));
  if (!(last_ > 0)) {
    columns_ = 0;
    return;
  }
  const double step = static_cast<double>(last_) / kSteps;
  const auto angle_at = [&](int i) { return i == kSteps ? widest : 2 * std::asin(step * i); };
  steps_.resize(static_cast<std::size_t>(columns_ + 1) * kRow);
  std::vector<Range> nodes(kRow, {INFINITY, 0});
  std::vector<double> candela(kRow);
  for (int c = 0; c <= columns_; ++c) {
    const double around = 2 * std::numbers::pi * (c % columns_) / columns_;
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = angle_at(i), sine = std::sin(angle), cosine = std::cos(angle);
      // At the pole the columns keep their own values, as beside it.
      const double across = std::max(sine, 2e-6);
      const double value = intensity(profile, {across * std::cos(around), across * std::sin(around), cosine});
      candela[static_cast<std::size_t>(i)] = value;
      const float radiance = value > 0 ? static_cast<float>(value / std::max(std::fabs(cosine), 1e-6)) : 0.0f;
      Range& node = nodes[static_cast<std::size_t>(i)];
      node = {std::min(node.least, radiance), std::max(node.most, radiance)};
    }
    double sum = 0;
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double rise = i < kSteps ? candela[i + 1] - candela[i] : 0;
      const auto high = static_cast<float>(sum);
      steps_[static_cast<std::size_t>(c) * kRow + i] = {high, static_cast<float>(sum - static_cast<double>(high)),
                                                        static_cast<float>(candela[i]), static_cast<float>(rise / 2)};
      sum += (candela[i] + rise / 2) * step;
    }
  }
  ranges_.resize(std::size_t{kLevels} * kBins);
  constexpr int kNodes = kSteps / kBins;
  for (int b = 0; b < kBins; ++b) {
    Range bin = nodes[static_cast<std::size_t>(b * kNodes)];
    for (int i = 1; i <= kNodes; ++i) {
      const Range& node = nodes[static_cast<std::size_t>(b * kNodes + i)];
      bin = {std::min(bin.least, node.least), std::max(bin.most, node.most)};
    }
    ranges_[static_cast<std::size_t>(b)] = bin;
  }
  for (int level = 1; level < kLevels; ++level)
    for (int b = 0; b + (1 << level) <= kBins; ++b) {
      const Range* below = &ranges_[static_cast<std::size_t>((level - 1) * kBins)];
      const Range &a = below[b], &c = below[b + (1 << (level - 1))];
      ranges_[static_cast<std::size_t>(level * kBins + b)] = {std::min(a.least, c.least), std::max(a.most, c.most)};
    }
}

double ProfileTable::mean(double t, double half, double at_column) const {
  const double per_step = kSteps / static_cast<double>(last_);
  // The integral from 0 to x, odd in x: an interval about the axis counts both of its sides.
  const auto integral = [&](const Step* steps, double x) {
    const double at = std::min(std::fabs(x) * per_step, static_cast<double>(kSteps));
    const auto i = static_cast<std::size_t>(at);
    const Step& s = steps[i];
    const double part = at - static_cast<double>(i);
    const double sum = static_cast<double>(s.sum) + static_cast<double>(s.sum_low) +
                       part * (static_cast<double>(s.intensity) + part * static_cast<double>(s.half_rise)) / per_step;
    return x < 0 ? -sum : sum;
  };
  const auto along = [&](int c) { return (integral(column(c), t + half) - integral(column(c), t - half)) / (2 * half); };
  if (columns_ == 1) return along(0);
  const int c = std::clamp(static_cast<int>(at_column), 0, columns_ - 1);
  const double a = along(c), b = along(c + 1);
  return a + (at_column - c) * (b - a);
}

}  // namespace steradian
