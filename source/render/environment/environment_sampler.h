// Directions sampled from a map in proportion to its radiance, for the reference methods.
#pragma once

#include <vector>

#include "render/environment/direction_grid.h"

namespace steradian::environment {

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
