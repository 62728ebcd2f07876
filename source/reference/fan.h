// Fan: a region of the sphere as the signed sum of triangles between one apex and the region's arcs. Its coordinates spread out a peak at
// the apex. No triangulation is needed: points outside the region are covered equally often with both signs, for any outline with holes.
//
// The triangles live in the lobe's own space (LobeShape). Their sides are straight there; the arcs need not be. The region above the
// horizon is convex in both kinds of that space, so no triangle reaches below it. For half vectors it is a disk in the plane h_z = 1.
#pragma once

#include <vector>

#include "lobes/lobe.h"
#include "reference/spherical_region.h"

namespace steradian::reference {

using lobes::LobeShape;

class RegionFan {
 public:
  // The apex is the lobe's peak if the region contains it, else the boundary's nearest point to it.
  RegionFan(const SphericalRegion& region, const LobeShape& shape);

  // A triangle, or the part of it on one side of the arc's point nearest to the apex. Coordinates: u along the arc from
  // that point, v in [0, 1] from apex to arc; both grow like the logarithm of the distance, beyond the lobe's width.
  struct Triangle {
    Vec3d nearest, along;  // the arc's points are nearest cos(tau) + along sin(tau), tau = tau_scale sinh(u)
    double tau_scale;
    double u_begin, u_end;
  };
  const std::vector<Triangle>& triangles() const { return triangles_; }
  bool is_stretched() const { return stretched_; }

  // All points of a triangle at one u.
  struct Ray {
    Vec3d across;      // unit, perpendicular to the apex: the ray's direction
    double v_scale;    // angle from the apex: theta_scale sinh(v v_scale)
    double measure;    // azimuth about the apex per du, signed, times v_scale
    double arc_speed;  // length of arc per du [rad]
  };
  Ray ray(const Triangle& triangle, double u) const;

  struct Point {
    Vec3d direction;  // unit, in the shading frame
    double measure;   // solid angle per du dv, signed
  };
  Point at(const Ray& ray, double v) const;

 private:
  Vec3d to_lobe_space(Vec3d v) const;
  void add_triangles(const Arc& arc);
  void add_triangle(const Arc& arc, double tau, double from, double to);
  std::vector<double> crossings(const Arc& arc, const Frame& axis) const;
  double nearest_tau(const Arc& arc, Vec3d to) const;

  LobeShape shape_;
  Vec3d inverse_x_, inverse_y_, inverse_z_;  // rows of the inverse of (x, y, z)
  double determinant_;
  bool half_vectors_;
  bool stretched_;      // by more than twice in one direction: a lobe of two widths
  Frame apex_;          // z is the apex
  double theta_scale_;  // scale on which the lobe falls off from the apex
  std::vector<Triangle> triangles_;
};

}  // namespace steradian::reference
