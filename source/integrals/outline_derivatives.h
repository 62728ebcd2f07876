// Derivatives of the light of an area light of any shape under any lobe, by quadrature along its outline (docs/theory/derivatives.md).
#pragma once

#include <array>
#include <vector>

#include "steradian/area_light.h"
#include "steradian/polygon_derivatives.h"

namespace steradian {

struct OutlineDerivatives {
  using ByChannel = std::array<Vec3d, 3>;
  // By the points and axes of the shape, in the order of its members. Polygons: each vertex as stored. Lines: zero.
  std::vector<ByChannel> by_vector;
  Vec3d by_radius;       // of a capsule, one number a channel
  ByChannel position{};  // by the point, with fixed normal and view
  ByChannel turn{};      // by a rotation vector that turns the light about the point
};

// Derivatives of the integral of `density` over the directions to the light, times its radiance. `density` does not change itself.
//
// The error is 1e-10 of the integral of their size along the outline, or what 20,000 halvings of a piece reach. Zero if nothing is visible
// of the light. Emission and texture do not count.
//
//   at    the density may end at the horizon of its normal
//   lobe  about where the density is narrow
OutlineDerivatives outline_derivatives(const AreaLight& light, const ShadingPoint& at, const LobeAxis& lobe, const LobeDensity& density);

}  // namespace steradian
