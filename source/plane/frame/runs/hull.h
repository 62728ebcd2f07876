// The hull of a tile and an emitter, by the circles around them.
#pragma once

#include <algorithm>
#include <cmath>

#include "plane/frame/tiles/cull.h"
#include "plane/frame/scene.h"
#include "plane/frame/runs/silhouette.h"

namespace steradian::plane {

// The hull is relative to the origin, like a BlockerList. Its slanted sides are (half + t growth) over the cosine of their slope away from
// the axis, and a circle's distance to them shrinks by that cosine too. If one circle nearly contains the other, it has the larger one's
// width.
inline HullOfCircles hull_of(const TileArea& tile, const Emitter& e, Vec2d origin) {
  const double half = tile.radius, bound = e.bound;
  const Vec2d axis = e.center - tile.center;
  const double length2 = dot(axis, axis), growth = bound - half;
  const double cosine2 = length2 > growth * growth ? 1 - growth * growth / length2 : 0;
  HullOfCircles hull;
  hull.x = static_cast<float>(tile.center.x - origin.x);
  hull.y = static_cast<float>(tile.center.y - origin.y);
  hull.axis_x = static_cast<float>(axis.x);
  hull.axis_y = static_cast<float>(axis.y);
  hull.inverse_length2 = length2 > 0 ? static_cast<float>(1 / length2) : 0;
  const bool slanted = cosine2 > 0.04;
  hull.base = static_cast<float>(slanted ? half : std::max(half, bound));
  hull.growth = slanted ? static_cast<float>(growth) : 0;
  hull.widen = slanted ? static_cast<float>(1 / std::sqrt(cosine2)) : 1;
  return hull;
}

}  // namespace steradian::plane
