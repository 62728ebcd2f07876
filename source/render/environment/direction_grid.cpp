#include "render/environment/direction_grid.h"

#include <algorithm>

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

}  // namespace steradian::environment
