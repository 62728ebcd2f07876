// SphericalRegion: the part of a light that a point sees, as arcs of great circles; quadrature and sampling share it. Clipping is done here
// on vertices (Sutherland-Hodgman), not as in kernels/outline/polygon.glsl, to stay independent.
#pragma once

#include <vector>

#include "steradian/polygon_light.h"

namespace steradian::reference {

// An arc from a to b, less than half a circle. A point is inside of the region where det(a, b, inside) > 0.
struct Arc {
  Vec3d a, b;    // unit
  Vec3d normal;  // unit, along a x b
  double angle;  // [rad]
};

struct SphericalRegion {
  // Closed contours, one after the other. A contour that a clipping plane cuts into parts stays one contour: its
  // parts are joined by arcs that run along the plane there and back, which cancel in every signed sum.
  std::vector<Arc> arcs;
  // Factor by which the rounding of the vertices' coordinates moves their directions, in units of the last place.
  double magnification = 1;

  // Refills the region and reuses its memory. The region is empty if the point sees no lit side.
  //
  //   frame    the frame of the arcs, at the shading point
  //   planes   only the part on their positive sides remains; their normals in the frame
  void assign(const PreparedPolygon& light, Vec3d position, const Frame& frame, const Vec3d* planes, int plane_count);

  // Refills the region with the part above the horizon of the shading frame.
  void assign_above_horizon(const PreparedPolygon& light, Vec3d position, const Frame& frame);

 private:
  std::vector<Vec3d> contour_, clipped_;
};

}  // namespace steradian::reference
