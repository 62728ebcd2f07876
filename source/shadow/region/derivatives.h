// Derivatives of the light that arrives past triangles: how the boundary of the visible part moves with the light, the triangles
// and the point. See docs/theory/shadows.md, "Derivatives".
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "shadow/region/visible_part.h"

namespace steradian::shadow {

using ByChannel = std::array<Vec3d, 3>;

struct BoundaryDerivatives {
  std::vector<ByChannel> light;      // by the vertices of the prepared light
  std::vector<ByChannel> occluders;  // by the vertices of the mesh; equal vertices that move together have it at the first one
  ByChannel position{};              // by the point
};

// Derivatives of the integral of `density` over the visible part. `density` (unit direction in world space; one number per channel) does
// not change itself.
//
// Sections of triangles by the light's plane move with the triangles and the point. Their motion with a light whose plane turns is left
// out. Degenerate cases: an edge that points at the point has no derivative and is skipped. A vertex of one surface on an edge of another
// opens a slit where it moves; there, this is one of two one-sided derivatives. Error: quadrature along arcs to 1e-9 of the largest
// piece's; pieces are 1.2e-7 of the light's half side off (docs/theory/shadows.md).
BoundaryDerivatives boundary_derivatives(const PreparedPolygon& light, const Occluders& occluders, const Viewpoint& from,
                                         const std::function<Vec3d(Vec3d)>& density);

}  // namespace steradian::shadow
