// Convex chains of an outline: a few edges that turn the same way, one after another.
//
// The edges and the chord that closes them bound a convex hull. From outside, every ray that passes through the hull crosses the chain,
// since it crosses the chord at most once. The hull blocks exactly as its edges do, and is one blocker instead of many.
#pragma once

#include <vector>

#include "plane/exact/outline.h"
#include "plane/frame/runs/silhouette.h"

namespace steradian::plane {

struct Chain {
  std::size_t first = 0, count = 0;  // edges, among the given curves
  std::vector<Vec2d> hull;           // its vertices, counter-clockwise
};

// The chains of curves[0, count), each of two edges or more and at most PaddedOutline::kMost vertices that turn by less than a right angle.
// Edges that belong to no chain are omitted.
std::vector<Chain> convex_chains(const Curve* curves, std::size_t count);

}  // namespace steradian::plane
