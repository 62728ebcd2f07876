// An environment's map over directions: DirectionGrid for integrals, EnvironmentSampler for the reference methods.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "steradian/environment.h"

namespace steradian::environment {

// DirectionGrid: an environment's map for integrals. It is constant over each of its texels, whose solid angles it knows.

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

// Directions sampled from a map in proportion to its radiance, for the reference methods.

class EnvironmentSampler {
 public:
  explicit EnvironmentSampler(DirectionGrid grid);

  // Samples a direction for u, v in [0, 1). Its density pdf(direction) per solid angle is nowhere zero.
  Vec3d sample(double u, double v) const;
  double pdf(Vec3d direction) const;
  Vec3d radiance(Vec3d direction) const;

 private:
  DirectionGrid grid_;
  std::vector<double> rows_;     // running integrals of the density up to each row's end
  std::vector<double> columns_;  // the same within every row
  double total_ = 0, uniform_ = 0;
  double weight(int column, int row) const;
};

}  // namespace steradian::environment
