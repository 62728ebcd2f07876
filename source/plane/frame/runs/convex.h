// Convex regions of the plane: hulls of a tile and an emitter, gaps between regions, chains of an outline.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "plane/exact/outline.h"
#include "plane/frame/runs/silhouette.h"
#include "plane/frame/scene.h"
#include "plane/frame/tiles/cull.h"
#include "steradian/vector2.h"

namespace steradian::plane {

// The hull of a tile and an emitter, by the circles around them.

// The hull is relative to the origin, like a BlockerList. Its slanted sides are (half + t growth) over the cosine of their slope away from
// the axis, and a circle's distance to them shrinks by that cosine too. If one circle nearly contains the other, it has the larger one's
// width.
inline HullOfCircles hull_of(const TileRectangle& tile, const Emitter& e, Vec2d origin) {
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

// Convex regions: polygons, counter-clockwise, and segments.

struct ConvexRegion {
  const Vec2d* vertices;
  std::size_t count;
};

// A line along an edge of one of two regions. `width` is the gap between them across it, less than 0 if they overlap.
struct Gap {
  double width;
  Vec2d normal, point;  // unit, towards the second region
};

// The widest of the gaps, or the first one that is wide enough.
Gap gap_between(ConvexRegion first, ConvexRegion second, double enough = 1e300);

bool holds(ConvexRegion region, Vec2d p);  // or its outline does
// The nearest point on its outline.
Vec2d nearest_of(ConvexRegion region, Vec2d p);

// Convex chains of an outline: a few edges that turn the same way, one after another.
//
// The edges and the chord that closes them bound a convex hull. From outside, every ray that passes through the hull crosses the chain,
// since it crosses the chord at most once. The hull blocks exactly as its edges do, and is one blocker instead of many.

struct Chain {
  std::size_t first = 0, count = 0;  // edges, among the given curves
  std::vector<Vec2d> hull;           // its vertices, counter-clockwise
};

// The chains of curves[0, count), each of two edges or more and at most PaddedOutline::kMost vertices that turn by less than a right angle.
// Edges that belong to no chain are omitted.
std::vector<Chain> convex_chains(const Curve* curves, std::size_t count);

// The closed outlines of curves[0, count) that follow each other, with the hulls around them. From outside, every ray that passes through
// such a hull crosses the outline: where it enters between two vertices of the hull, it leaves elsewhere.
std::vector<Chain> closed_outlines(const Curve* curves, std::size_t count);

// The corners of the convex hull of points, counter-clockwise.
std::vector<Vec2d> hull_around(std::vector<Vec2d> points);

}  // namespace steradian::plane
