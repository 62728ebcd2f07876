// Suns with only opaque bodies in front of them: their visible part does not depend on the order of the blockers.
#pragma once

#include <vector>

#include "plane/exact/world.h"

namespace steradian::plane {

// A sun, and the curves that may lie between it and the points of a disk.
struct SunView {
  const PlaneSun* sun;
  std::vector<const Curve*> blocking;
};

// Is the sun at most as wide as half of the sky?
bool is_plain(const PlaneSun& sun);

// Adds the integral over the directions in which a plain sun is visible, for points outside of all bodies. A sun without width counts fully
// or not at all.
void add_open_sun(const SunView& view, Vec2d from, PlaneLight& sum);

}  // namespace steradian::plane
