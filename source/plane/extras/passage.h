// Fraction of light that remains after a straight path through bodies that transmit or absorb it.
#pragma once

#include <span>
#include <vector>

#include "plane/exact/world.h"

namespace steradian::plane {

// Bodies that hold a point.
struct Start {
  bool dark = false;      // within an occluder that lets no light in
  int light = -1;         // index of the last light
  std::vector<int> deep;  // bodies that absorb light
};
Start start_at(const World& world, Vec2d p);

// Does light from or to that point go on through the body? Other bodies end it.
bool passes(const World& world, const Start& start, int body);

// The fraction that remains after a path of length `way` (may be infinite) in direction u. filters: curves, grouped by body, of which those
// that light passes count.
Vec3d passage(const World& world, const Start& start, std::span<const Curve* const> filters, Vec2d from, Vec2d u, double way);

}  // namespace steradian::plane
