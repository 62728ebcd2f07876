// DirectionGrid: an environment's map for integrals. It is constant over each of its texels, whose solid angles it knows.
#pragma once

#include <cmath>
#include <numbers>

#include "steradian/environment.h"

namespace steradian::environment {

struct DirectionGrid {
  Picture map;

  // The map averaged down by solid angle to at most `most_columns` columns, and half as many rows.
  static DirectionGrid averaged(const Picture& map, int most_columns);

  // The same map in at least `least_columns` columns: every texel is repeated.
  static DirectionGrid repeated(const DirectionGrid& grid, int least_columns);

  double solid_angle(int row) const {
    const double top = std::numbers::pi * row / map.height, bottom = std::numbers::pi * (row + 1) / map.height;
    return 2 * std::numbers::pi / map.width * (std::cos(top) - std::cos(bottom));
  }
  Vec3d direction(double column, double row) const { return direction_of({column / map.width, row / map.height}); }
  Vec3d center(int column, int row) const { return direction(column + 0.5, row + 0.5); }

  struct Cell {
    int column, row;
  };
  Cell cell_of(Vec3d direction) const;
};

}  // namespace steradian::environment
