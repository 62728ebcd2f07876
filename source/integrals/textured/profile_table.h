// ProfileTable: a light's profile of type C in equal steps, for means over intervals of angle and for the range of the radiance.
//
// The angle theta from the light's normal stands as t = sin(theta / 2): t is nearly linear in theta, and one square root of the direction.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "steradian/light_profile.h"

namespace steradian {

class ProfileTable {
 public:
  static constexpr int kSteps = 1024;  // finer than the 512 steps of the exporter's profiles
  static constexpr int kMostColumns = 72;

  explicit ProfileTable(const LightProfile& profile);

  // False for type B, and for horizontal angles that are no multiples of one step: the table then holds nothing.
  bool serves() const { return columns_ > 0; }

  // Intensity over the cosine from the normal, for directions with t in an interval and any horizontal angle.
  struct Range {
    float least = 0, most = 0;
  };
  Range range(float from, float to) const;

  // Mean intensity over t from t - half to t + half, half >= least_half(). column: of the horizontal angle, in [0, columns()].
  double mean(double t, double half, double at_column) const;
  // Shorter intervals would lose the digits of the sums.
  float least_half() const { return step() / 2; }

  // One step of a column: the integral of the intensity over t from 0 to the step's beginning, the intensity there, and half of its rise.
  // sum_low is what the sum lacks as a float: where the profile is dim, the difference of two sums is small.
  struct Step {
    float sum, sum_low, intensity, half_rise;
  };
  // 0 <= i <= columns(); the last equals the first.
  const Step* column(int i) const { return &steps_[static_cast<std::size_t>(i) * kRow]; }
  int columns() const { return columns_; }  // equal steps of the horizontal angle; 1: the same all around
  float last() const { return last_; }      // t of the profile's last angle: nothing shines beyond
  float step() const { return last_ / static_cast<float>(kSteps); }

  static constexpr std::size_t kRow = kSteps + 1;

 private:
  static constexpr int kBins = 256, kLevels = 9;  // bins of four steps; level k has the range of 2^k bins

  int columns_ = 0;
  float last_ = 0;
  std::vector<Step> steps_;
  std::vector<Range> ranges_;  // by level, then by bin
};

inline ProfileTable::Range ProfileTable::range(float from, float to) const {
  const float bins = static_cast<float>(kBins) / last_;
  if (from > last_) return {};
  const int first = std::clamp(static_cast<int>(from * bins), 0, kBins - 1);
  const int last = std::clamp(static_cast<int>(to * bins), first, kBins - 1);
  const int level = std::bit_width(static_cast<unsigned>(last - first + 1)) - 1;
  const Range* row = &ranges_[static_cast<std::size_t>(level) * kBins];
  const Range &a = row[first], &b = row[last + 1 - (1 << level)];
  Range result = {std::min(a.least, b.least), std::max(a.most, b.most)};
  if (to > last_) result.least = 0;
  return result;
}

}  // namespace steradian
