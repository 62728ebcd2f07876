// FilteredMap: an environment's map blurred to ever larger widths, for lobes that gather it through a few cones of directions.
#pragma once

#include <vector>

#include "render/environment/direction_grid.h"

namespace steradian::environment {

class FilteredMap {
 public:
  explicit FilteredMap(const DirectionGrid& grid);

  // Mean of the map about a unit direction, weighted by a Gaussian with standard deviation `width` [rad] in each of its two directions.
  // Widths range from half a texel of the finest level to at least 0.3.
  Vec3f mean(Vec3f direction, float width) const;

 private:
  // The eight faces of an octahedron as a square, with a border that repeats the texels across its edges.
  // Source: Engelhardt, Dachsbacher, "Octahedron environment maps", 2008.
  struct Level {
    int side = 0;
    std::vector<Vec3f> texels;  // (side + 2)^2
    Vec3f& at(int x, int y) { return texels[static_cast<std::size_t>((y + 1) * (side + 2) + x + 1)]; }
    const Vec3f& at(int x, int y) const { return texels[static_cast<std::size_t>((y + 1) * (side + 2) + x + 1)]; }
    Vec3f linear(Vec3f direction) const;
    void fill_border();
  };
  static Level blurred(const Level& finer, int side, double width);

  std::vector<Level> levels_;
  float finest_texel_ = 0;  // mean side of the first level's texels [rad]
};

}  // namespace steradian::environment
