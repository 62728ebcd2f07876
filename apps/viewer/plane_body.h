// Bodies of the plane under a hand: which one a point is in, and what it looks like moved, turned and scaled.
#pragma once

#include <optional>

#include "steradian/plane.h"

namespace steradian::view {

// The uppermost body that a point is in, or within `reach` of: thin ones are hard to hit.
std::optional<std::size_t> body_at(const PlaneScene& scene, Vec2d point, double reach);

struct PlaneBox {
  Vec2d low, high;
  Vec2d middle() const { return (low + high) * 0.5; }
};
PlaneBox bounds_of(const PlaneBody& body);

PlaneBody moved(PlaneBody body, Vec2d by);
// About a point; a gradient goes along, a spot's axis turns.
PlaneBody scaled(PlaneBody body, Vec2d about, double factor);
PlaneBody turned(PlaneBody body, Vec2d about, double angle);  // radians, clockwise as seen: y is down

}  // namespace steradian::view
