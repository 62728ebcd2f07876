// SphericalRectangle: directions within a rectangular light, uniform by solid angle.
// Source: Urena, Fajardo, King, "An area-preserving parametrization for spherical rectangles", 2013.
#pragma once

#include "steradian/vector.h"

namespace steradian::reference {

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

}  // namespace steradian::reference
