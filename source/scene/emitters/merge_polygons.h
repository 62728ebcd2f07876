// Merges coplanar adjacent triangles into polygons with holes, so that a light of many triangles is one light
// with few edges.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "steradian/vector.h"

namespace steradian::scene {

using Triangle = std::array<Vec3d, 3>;

struct MergedPolygon {
  std::vector<Vec3d> outline;  // counter-clockwise as seen from the triangles' front
  std::vector<std::vector<Vec3d>> holes;
  std::vector<std::size_t> triangles;  // the merged triangles, the largest first
};

struct MergedPolygons {
  std::vector<MergedPolygon> polygons;  // in the order of their first triangles
  std::size_t without_area = 0;         // triangles skipped: thinner than the rounding of their coordinates
  std::size_t first_without_area = 0;   // the first of them
};

// Triangles are adjacent if two corners are equal to the last bit. A patch grows from its largest triangle. It takes triangles that face
// the same way (to 2.6 degrees). Their corners may be off its plane by at most 5e-6 of its size and the rounding of single precision.
// may_join(a, b): true if triangle b belongs to the patch that grows from a, for example if both have the same texture map.
//
// A patch with an ambiguous outline stays triangles: more edges, the same light. An outline is ambiguous if it touches itself in a corner,
// overlaps itself or has an edge of three triangles.
MergedPolygons merge_coplanar(const std::vector<Triangle>& triangles, const std::function<bool(std::size_t, std::size_t)>& may_join);

}  // namespace steradian::scene
