// Groups: neighbouring surface points whose shadows are computed together.
#pragma once

#include <cstdint>
#include <vector>

#include "render/tile/tile.h"
#include "steradian/vector.h"

namespace steradian {

// Slots of a tile in groups of 8 x 8 pixels, split at depth gaps: a shaft around both sides of a depth edge contains too much. Clusters are
// groups without a gap between them.
struct PointGroups {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::vector<std::uint32_t>> clusters;  // numbers of groups
};

// Groups of lit surfaces. positions: for every slot with a surface.
PointGroups groups_of(const SurfaceTile& tile, const std::vector<Vec3d>& positions);

}  // namespace steradian
