// Triangulates a polygon with holes, between its own corners.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "steradian/vector2.h"

namespace steradian {

using Contours = std::vector<std::vector<Vec2d>>;

// The first contour runs counter-clockwise, the holes in it clockwise. Corners are numbered contour after contour. All triangles run
// counter-clockwise. Empty if contours cross or touch, or have no area: no polygon has such an outline.
//
// Ear clipping, after bridging holes to the contour around them. Source: Eberly, "Triangulation by ear clipping", 2002. Cubic in the number
// of corners at worst.
std::optional<std::vector<std::array<std::uint32_t, 3>>> triangles_of(const Contours& contours);

}  // namespace steradian
