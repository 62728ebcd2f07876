// Suns that nothing but opaque bodies stands before: how much of them is seen needs no order of what blocks.
#pragma once

#include <vector>

#include "plane/exact/world.h"

namespace steradian::plane {

// A sun, and the curves that may stand between it and the points of a disk.
struct SunView {
  const PlaneSun* sun;
  std::vector<const Curve*> blocking;
};

// As wide as half of the sky, or less.
bool is_plain(const PlaneSun& sun);

// Adds the integral over the directions in which a plain sun is seen from outside of all bodies; of a sun without width, all of it or
// nothing.
void add_open_sun(const SunView& view, Vec2d from, PlaneLight& sum);

}  // namespace steradian::plane
