// Body: the solid of a round light, an ellipsoid or a tube. It is convex.
#pragma once

#include <optional>
#include <vector>

#include "core/box.h"
#include "steradian/shape.h"

namespace steradian {

class Body {
 public:
  // None for a flat light, a line, and a shape without volume.
  static std::optional<Body> of(const Shape& shape);

  const Box3d& box() const { return box_; }  // around it
  bool contains(Vec3d p) const;
  friend bool operator==(const Body& a, const Body& b);  // of equal shapes

  // The part of a line inside: from origin + enters direction to origin + leaves direction. None if the line misses the body.
  struct Span {
    double enters, leaves;
  };
  std::optional<Span> span(Vec3d origin, Vec3d direction) const;

  // A polygon for the body's section by the plane dot(normal, x) = offset. Its corners lie on the surface, or, for an ellipsoid, slightly
  // out of it, so that the area is right. No corners: the plane misses the body.
  std::vector<Vec3d> section(Vec3d normal, double offset) const;

 private:
  explicit Body(const Shape& shape) : shape_(shape) {}

  Shape shape_;
  Box3d box_;
  Vec3d rows_[3];  // for an ellipsoid, the map to the space in which it is the unit sphere
};

}  // namespace steradian
