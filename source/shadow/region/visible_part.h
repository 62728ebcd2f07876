// The visible part of a flat light behind triangles, for a single point and for every integral that walks a light's outline.
#pragma once

#include "shadow/edges/edges.h"
#include "shadow/edges/segments.h"
#include "shadow/rays/triangle_rays.h"

namespace steradian::shadow {

// Triangles that block light, prepared once.
struct Occluders {
  explicit Occluders(EdgeMesh m);
  // The same triangles, cut along the surface of a body.
  Occluders cut_by(const Body& body) const;
  EdgeMesh mesh;
  TriangleRays rays;
  double reach = 0;  // largest coordinate of the triangles
};

// Converts a region to a light: each piece is a contour of two vertices (visible_part). side: side on which the point lies.
PreparedPolygon light_of(const VisibleRegion& region, const PreparedPolygon& light, const LightFrame& frame, int side,
                         const Viewpoint& from, double lift);

// The pieces that bound the visible part, in walk order for this point, above both horizons. Each piece is a contour of two vertices: the
// one edge from the first to the second. No vertices: nothing is visible.
//
//   lift     directions closer than this to the shading horizon are lifted to it [rad], so that no rounding puts a piece below it: 1e-9
//   for integrals in double, 1e-6 in float
//   body     of the round light that the polygon represents for this point; what is inside it does not block
PreparedPolygon visible_part(const PreparedPolygon& light, const Occluders& occluders, const Viewpoint& from, double lift,
                             const Body* body = nullptr);

}  // namespace steradian::shadow
