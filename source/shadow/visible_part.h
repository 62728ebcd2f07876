// What a single point sees of a flat light behind triangles, for every integral that walks a light's outline.
#pragma once

#include "shadow/edges.h"
#include "shadow/segments.h"
#include "shadow/triangle_rays.h"

namespace steradian::shadow {

// Triangles that block light, made ready once.
struct Occluders {
  explicit Occluders(EdgeMesh m) : mesh(std::move(m)), rays(mesh) {}
  EdgeMesh mesh;
  TriangleRays rays;
};

// A region as a light: its pieces, each a contour of two vertices (visible_part). side: on which the point stands.
PreparedPolygon light_of(const VisibleRegion& region, const PreparedPolygon& light, const LightFrame& frame, int side,
                         const Viewpoint& from, double lift);

// The pieces that bound the visible part, in walk order for this point, each a contour of two vertices: such a contour is the
// one edge from the first to the second. Above both horizons. No vertices: nothing is seen.
//
//   lift     directions closer than this to the shading horizon are lifted there [rad], so that no rounding puts a piece below
//            it: 1e-9 for integrals in double, 1e-6 in float
PreparedPolygon visible_part(const PreparedPolygon& light, const Occluders& occluders, const Viewpoint& from, double lift);

}  // namespace steradian::shadow
