#include "render/environment/direction_grid.h"

#include <algorithm>

#include "steradian/area_light.h"  // luminance

namespace steradian::environment {

DirectionGrid DirectionGrid::averaged(const Picture& map, int most_columns) {
  const int most_rows = std::max(most_columns / 2, 1);
  DirectionGrid result{Picture(std::min(map.width, most_columns), std::min(map.height, most_rows))};
  const auto from = static_cast<double>(std::numbers::pi / map.height);
  for (int row = 0; row < result.map.height; ++row) {
    const int first = static_cast<int>(std::int64_t{map.height} * row / result.map.height);
    const int last = static_cast<int>(std::int64_t{map.height} * (row + 1) / result.map.height);
    for (int column = 0; column < result.map.width; ++column) {
      const int left = static_cast<int>(std::int64_t{map.width} * column / result.map.width);
      const int right = static_cast<int>(std::int64_t{map.width} * (column + 1) / result.map.width);
      Vec3d sum{};
      double weight = 0;
      for (int j = first; j < last; ++j) {
        const double of_row = std::cos(from * j) - std::cos(from * (j + 1));
        for (int i = left; i < right; ++i) sum += static_cast<Vec3d>(map.at(i, j)) * of_row;
        weight += of_row * (right - left);
      }
      result.map.at(column, row) = static_cast<Vec3f>(sum / weight);
    }
  }
  return result;
}

DirectionGrid DirectionGrid::repeated(const DirectionGrid& grid, int least_columns) {
  const int across = (least_columns + grid.map.width - 1) / grid.map.width, rows = std::max(least_columns / 2, 1);
  const int down = (rows + grid.map.height - 1) / grid.map.height;
  if (across <= 1 && down <= 1) return grid;
  DirectionGrid result{Picture(grid.map.width * across, grid.map.height * down)};
  for (int j = 0; j < result.map.height; ++j)
    for (int i = 0; i < result.map.width; ++i) result.map.at(i, j) = grid.map.at(i / across, j / down);
  return result;
}

DirectionGrid::Cell DirectionGrid::cell_of(Vec3d direction) const {
  const MapPlace place = place_of(direction);
  return {std::clamp(static_cast<int>(place.u * map.width), 0, map.width - 1),
          std::clamp(static_cast<int>(place.v * map.height), 0, map.height - 1)};
}

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
