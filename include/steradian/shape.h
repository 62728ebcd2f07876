// Shape: the form of a light with an extent. Each shape's outline from a point is in source/shapes/.
#pragma once

#include <variant>
#include <vector>

#include "steradian/vector.h"

namespace steradian {

// A flat polygon. The lit side is the one from which the outline runs counter-clockwise. Holes run in reverse; either order is accepted.
struct Polygon {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<Vec3d>> holes;

  bool operator==(const Polygon&) const = default;
};

// A flat ellipse: points center + x u + y v, |(u, v)| <= 1. Lit side: that of x cross y.
struct Ellipse {
  Vec3d center, x, y;

  bool operator==(const Ellipse&) const = default;
};

// An ellipsoid: points center + x u + y v + z w, |(u, v, w)| <= 1.
struct Ellipsoid {
  Vec3d center, x, y, z;

  bool operator==(const Ellipsoid&) const = default;
};

// A tube: all points within the radius of the segment between the ends.
struct Capsule {
  Vec3d end_a, end_b;
  double radius = 0;

  bool operator==(const Capsule&) const = default;
};

// A segment without width.
struct Line {
  Vec3d end_a, end_b;

  bool operator==(const Line&) const = default;
};

using Shape = std::variant<Polygon, Ellipse, Ellipsoid, Capsule, Line>;

}  // namespace steradian
