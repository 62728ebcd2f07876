#include "render/environment/environment_sampler.h"

#include <algorithm>

#include "steradian/area_light.h"  // luminance

namespace steradian::environment {

// Unnormalized density: the luminance, plus a tenth of its mean everywhere.
double EnvironmentSampler::weight(int column, int row) const { return luminance(static_cast<Vec3d>(grid_.map.at(column, row))) + uniform_; }

EnvironmentSampler::EnvironmentSampler(DirectionGrid grid) : grid_(std::move(grid)) {
  double power = 0;
  for (int j = 0; j < grid_.map.height; ++j)
    for (int i = 0; i < grid_.map.width; ++i) power += weight(i, j) * grid_.solid_angle(j);
  uniform_ = power > 0 ? 0.1 * power / (4 * std::numbers::pi) : 1;
  for (int j = 0; j < grid_.map.height; ++j) {
    double row = 0;
    for (int i = 0; i < grid_.map.width; ++i) columns_.push_back(row += weight(i, j) * grid_.solid_angle(j));
    rows_.push_back(total_ += row);
  }
}

Vec3d EnvironmentSampler::sample(double u, double v) const {
  const auto find = [](auto first, auto last, double sought) {
    const auto it = std::min(std::upper_bound(first, last, sought), last - 1);
    const double before = it == first ? 0 : *(it - 1);
    return std::pair{static_cast<int>(it - first), *it > before ? std::clamp((sought - before) / (*it - before), 0.0, 1.0) : 0.5};
  };
  const auto [row, down] = find(rows_.begin(), rows_.end(), v * total_);
  const auto begin = columns_.begin() + std::ptrdiff_t{row} * grid_.map.width, end = begin + grid_.map.width;
  const auto [column, across] = find(begin, end, u * *(end - 1));
  // Uniform in solid angle within the texel, that is in the height.
  const double top = std::cos(std::numbers::pi * row / grid_.map.height),
               bottom = std::cos(std::numbers::pi * (row + 1) / grid_.map.height);
  const double height = top + (bottom - top) * down;
  return grid_.direction(column + across, std::acos(std::clamp(height, -1.0, 1.0)) / std::numbers::pi * grid_.map.height);
}

double EnvironmentSampler::pdf(Vec3d direction) const {
  const DirectionGrid::Cell c = grid_.cell_of(direction);
  return weight(c.column, c.row) / total_;
}

Vec3d EnvironmentSampler::radiance(Vec3d direction) const {
  const DirectionGrid::Cell c = grid_.cell_of(direction);
  return static_cast<Vec3d>(grid_.map.at(c.column, c.row));
}

}  // namespace steradian::environment
