// The part of an outline within others, or outside: clipPath and mask.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane::svg {

// Filled outlines, of which the union is kept.
using ClipRegion = std::vector<PlaneBody>;

// The body as polygons or polylines, off by `tolerance` at most where it is round.
PlaneBody flattened(const PlaneBody& body, double tolerance);

// The part of a body within the region: the body itself where all of it is, no contours where nothing is. `region` is
// polygons; `spend` is told of the pairs of edges that are looked at.
PlaneBody clipped(const PlaneBody& body, const ClipRegion& region, double tolerance, const std::function<void(std::uint64_t)>& spend);

// What of a filled outline lies outside of another. Both are polygons, and so is the result, without contours where nothing is left.
PlaneBody without(const PlaneBody& body, const PlaneBody& part, double tolerance, const std::function<void(std::uint64_t)>& spend);

}  // namespace steradian::plane::svg
