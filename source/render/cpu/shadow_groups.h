// Groups: neighbouring surface points that look at a light together.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cpu/tile.h"
#include "steradian/vector.h"

namespace steradian {

// Slots of a tile in groups of 8 x 8 pixels, split at depth gaps: a shaft around both sides of a depth edge holds too much. Clusters
// are groups without a gap between them.
struct PointGroups {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::vector<std::uint32_t>> clusters;  // numbers of groups
};

// Of lit surfaces. positions: of every slot with one.
PointGroups groups_of(const SurfaceTile& tile, const std::vector<Vec3d>& positions);

}  // namespace steradian
