// Shape: the outlines that are no polygon's vertices, as what asks for light names them.
#pragma once

#include <variant>

#include "steradian/area_light.h"  // Ellipse, Capsule

namespace steradian {

// Points center + x u + y v + z w, |(u, v, w)| = 1.
struct Ellipsoid {
  Vec3d center, x, y, z;
};

// A segment without width.
struct Line {
  Vec3d end_a, end_b;
};

// An ellipse's lit side is that of x cross y.
using CurvedShape = std::variant<Ellipse, Ellipsoid, Capsule, Line>;

// A line where the radius is 0.
inline CurvedShape capsule_or_line(Vec3d end_a, Vec3d end_b, double radius) {
  if (radius == 0) return Line{end_a, end_b};
  return Capsule{end_a, end_b, radius};
}

struct CurvedLight {
  CurvedShape shape;
  Vec3d radiance{1, 1, 1};  // of a line, radiance times width
  bool two_sided = false;   // of an ellipse
};

// Without size.
struct PointLight {
  Vec3d position;
  Vec3d intensity{1, 1, 1};  // W/sr or candela, linear RGB
};

}  // namespace steradian
