// Strokes with round caps and joins: all points nearer than a radius to a polyline.
#pragma once

#include <vector>

#include "steradian/plane.h"

namespace steradian::plane::svg {

// A capsule if the line is one segment, else a filled outline no further than `tolerance` from the exact stroke.
PlaneBody stroke_of(const std::vector<Vec2d>& line, bool closed, double radius, double tolerance);

}  // namespace steradian::plane::svg
