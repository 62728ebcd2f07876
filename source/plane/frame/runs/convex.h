// Convex regions: polygons, counter-clockwise, and segments.
#pragma once

#include <cstddef>

#include "steradian/vector2.h"

namespace steradian::plane {

struct ConvexRegion {
  const Vec2d* vertices;
  std::size_t count;
};

// A line along an edge of one of two regions. `width` is the gap between them across it, less than 0 if they overlap.
struct Gap {
  double width;
  Vec2d normal, point;  // unit, towards the second region
};

// The widest of the gaps, or the first one that is wide enough.
Gap gap_between(ConvexRegion first, ConvexRegion second, double enough = 1e300);

bool holds(ConvexRegion region, Vec2d p);  // or its outline does
// The nearest point on its outline.
Vec2d nearest_of(ConvexRegion region, Vec2d p);

}  // namespace steradian::plane
