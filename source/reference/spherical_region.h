// Light as a region of directions, for the reference: SphericalRectangle and SphericalRegion.
#pragma once

#include <vector>

#include "steradian/polygon_light.h"
#include "steradian/vector.h"

namespace steradian::reference {

// SphericalRectangle: directions within a rectangular light, uniform by solid angle.
// Source: Urena, Fajardo, King, "An area-preserving parametrization for spherical rectangles", 2013.

class SphericalRectangle {
 public:
  // A rectangle with a corner and two edges at right angles, relative to the viewing point.
  SphericalRectangle(Vec3d corner, Vec3d edge_x, Vec3d edge_y);

  double solid_angle() const { return solid_angle_; }

  // A unit direction, for u, v in [0, 1); the zero vector for a rectangle viewed from its plane.
  Vec3d sample(double u, double v) const;
  double pdf(Vec3d direction) const;

 private:
  Vec3d x_, y_, z_;  // axes of the rectangle, z away from it: it lies at z = z0_ < 0
  double x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0, z0_ = 0;
  double b0_ = 0, b1_ = 0, k_ = 0, solid_angle_ = 0;
};

// SphericalRegion: the part of a light that a point sees, as arcs of great circles; quadrature and sampling share it. Clipping is done here
// on vertices (Sutherland-Hodgman), not as in kernels/outline/polygon.glsl, to stay independent.

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
