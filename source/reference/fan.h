// Fan: a region of the sphere as the signed sum of triangles between one apex and the region's arcs, with coordinates
// that open up a peak at the apex. No triangulation: whatever lies outside the region is covered as often positively
// as negatively, for any outline with holes.
#pragma once

#include <vector>

#include "reference/lobe.h"
#include "reference/spherical_region.h"

namespace steradian::reference {

// One triangle, or a part of it, in stretched space. Coordinates: (tau, theta), tau along the arc from the point
// nearest to the apex, theta from the apex. Both are stretched once more by sinh, which spreads scales evenly.
struct FanTriangle {
  Vec3d x, y;            // with the apex an orthonormal frame; x to the nearest point of the arc's circle
  double sine, cosine;   // of the distance from the apex to that circle; negative: the triangle counts negative
  double tau_scale;      // tau = tau_scale sinh(u)
  double u_begin, u_end;
};

// The point of the sphere at (u, v), v in [0, 1] from apex to arc.
struct FanPoint {
  Vec3d direction;  // unit, in the shading frame
  double measure;   // solid angle per du dv, signed
};

class Fan {
 public:
  // The apex is the lobe's peak where the region holds it, else the boundary's nearest point to it, as measured in a
  // space where the lobe is round.
  Fan(const SphericalRegion& region, const LobeShape& shape);

  const std::vector<FanTriangle>& triangles() const { return triangles_; }

  // Ray of a triangle at u: what all its points share.
  struct Ray {
    Vec3d along;         // perpendicular to the apex
    double v_scale;      // theta = theta_scale sinh(v v_scale)
    double measure;      // d phi / du, signed, times v_scale
    double arc_speed;    // length of arc per du
  };
  Ray ray(const FanTriangle& triangle, double u) const;
  FanPoint at(const Ray& ray, double v) const;

 private:
  Vec3d column_x_, column_y_, column_z_;  // from stretched space to the shading frame
  double determinant_;
  Vec3d apex_;
  double theta_scale_;
  std::vector<FanTriangle> triangles_;
};

}  // namespace steradian::reference
