// Editing bodies of the plane: the body at a point, and copies that are moved, turned and scaled.
#pragma once

#include <optional>

#include "plane/exact/outline.h"
#include "steradian/plane.h"

namespace steradian::view {

// The uppermost body that contains a point, or is within `reach` of it, because thin bodies are hard to hit.
std::optional<std::size_t> body_at(const PlaneScene& scene, Vec2d point, double reach);

using plane::bounds_of;

PlaneBody moved(PlaneBody body, Vec2d by);
// Scales about a point. A gradient scales along, a spot's axis turns.
PlaneBody scaled(PlaneBody body, Vec2d about, double factor);
PlaneBody turned(PlaneBody body, Vec2d about, double angle);  // radians, clockwise on screen: y points down

}  // namespace steradian::view
