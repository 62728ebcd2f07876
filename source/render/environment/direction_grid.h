// DirectionGrid: an environment's map as integrals see it, constant over each of its texels, whose solid angles it knows.
#pragma once

#include <cmath>
#include <numbers>

#include "steradian/environment.h"

namespace steradian::environment {

struct DirectionGrid {
  Picture map;

  // Averaged down by solid angle to at most so many columns, and half as many rows.
  static DirectionGrid averaged(const Picture& map, int most_columns);

  // The same map in at least so many columns: every texel several times.
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
