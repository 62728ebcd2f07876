// The part of an outline inside or outside of others: clipPath and mask.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "steradian/plane.h"

namespace steradian::plane::svg {

// Filled outlines; the region is their union.
using ClipRegion = std::vector<PlaneBody>;

// The body as polygons or polylines, with an error of at most `tolerance` for round shapes.
PlaneBody flattened(const PlaneBody& body, double tolerance);

// The part of a body within the region: the unchanged body if all of it is inside, no contours if nothing is. `region` consists of
// polygons; `spend` receives the number of tested pairs of edges.
PlaneBody clipped(const PlaneBody& body, const ClipRegion& region, double tolerance, const std::function<void(std::uint64_t)>& spend);

// The part of a filled outline outside of another. Both are polygons, and so is the result, which has no contours if nothing remains.
PlaneBody without(const PlaneBody& body, const PlaneBody& part, double tolerance, const std::function<void(std::uint64_t)>& spend);

}  // namespace steradian::plane::svg
