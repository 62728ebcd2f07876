// Points on curves, up to the rounding of coordinates.
#pragma once

#include <vector>

#include "plane/exact/outline.h"

namespace steradian::plane {

// Distance of a point near the curve; of an arc, to first order.
double distance_to(const Curve& curve, Vec2d p);

bool is_on(const Curve& curve, Vec2d p);

// Places beside a point on curves, off all of them by a few times its rounding, the best first. They lie in the middles of the wedges
// between the curves' tangents, the widest first.
std::vector<Vec2d> places_beside(const std::vector<const Curve*>& curves, Vec2d p);

}  // namespace steradian::plane
