// What is left of light after a straight way through bodies that let it through or take it in.
#pragma once

#include <span>
#include <vector>

#include "plane/exact/world.h"

namespace steradian::plane {

// What holds a point.
struct Start {
  bool dark = false;      // an occluder that lets no light in
  int light = -1;         // the last light
  std::vector<int> deep;  // bodies that take light in
};
Start start_at(const World& world, Vec2d p);

// Does light from or to that point go on through the body? Others end it.
bool passes(const World& world, const Start& start, int body);

// The share that is left after a way (it may be infinite) in direction u. filters: curves of which those that light passes count, body by
// body.
Vec3d passage(const World& world, const Start& start, std::span<const Curve* const> filters, Vec2d from, Vec2d u, double way);

}  // namespace steradian::plane
