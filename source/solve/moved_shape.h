// The sizes of shapes, and shapes that a fit has moved.
#pragma once

#include <optional>
#include <vector>

#include "steradian/shape.h"
#include "steradian/vector.h"

namespace steradian::solving {

Vec3d center_of(const Shape& shape);

// Two half axes of a polygon that is a parallelogram; none for others.
std::optional<Ellipse> half_axes_of(const Polygon& polygon);

// Sizes that a fit may change [m], by their words.
struct ShapeSize {
  const char* word;
  double value;
};
std::vector<ShapeSize> sizes_of(const Shape& shape);

// Surface of a shape over that of the shape scaled by two factors.
double area_ratio(const Shape& shape, double f1, double f2);

// A rotation and a move of the centre, with factors on the shape's own sizes.
struct Motion {
  Vec3d center, by, rotation;  // place of the centre before, its move, rotation vector
  double f1 = 1, f2 = 1;

  Vec3d turned(Vec3d v) const {
    const double angle = length(rotation);
    return angle > 0 ? rotated(v, rotation / angle, angle) : v;
  }
  Vec3d moved(Vec3d p) const { return center + by + turned(p - center); }
};
Shape moved(const Shape& shape, const Motion& motion);

}  // namespace steradian::solving
