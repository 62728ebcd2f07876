// Derivatives of the light that arrives past triangles: how the boundary of the visible part moves with the light, the triangles
// and the point. See docs/shadows.md, "Derivatives".
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "shadow/visible_part.h"

namespace steradian::shadow {

using ByChannel = std::array<Vec3d, 3>;

struct BoundaryDerivatives {
  std::vector<ByChannel> light;      // by the vertices of the light as it is prepared
  std::vector<ByChannel> occluders;  // by the vertices of the mesh; where some are equal and move together, it stands at the first
  ByChannel position{};              // by the point
};

// Of the integral over the visible part of `density` (unit direction in world space; a number a channel), which itself does not change.
//
// Sections of triangles by the light's plane move with the triangles and the point; that they move with a light whose plane turns is left
// out. Degenerate: an edge that points at the point has no derivative and is left out; at a vertex of one surface that lies on an edge of
// another, which opens a slit where it moves, this is one of two one-sided derivatives. Error: quadrature along arcs to 1e-9 of the largest
// piece's; pieces are 1.2e-7 of the light's half side off (docs/shadows.md).
BoundaryDerivatives boundary_derivatives(const PreparedPolygon& light, const Occluders& occluders, const Viewpoint& from,
                                         const std::function<Vec3d(Vec3d)>& density);

}  // namespace steradian::shadow
