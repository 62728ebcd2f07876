// The points of a tile as shadows use them, and their groups.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/surface/ray_scene.h"
#include "render/tile/tile.h"
#include "shadow/edges/segments.h"
#include "steradian/render.h"
#include "steradian/vector.h"

namespace steradian {

// Groups: neighbouring surface points whose shadows are computed together.

// Slots of a tile in groups of 8 x 8 pixels, split at depth gaps: a shaft around both sides of a depth edge contains too much. Clusters are
// groups without a gap between them.
struct PointGroups {
  std::vector<std::vector<std::uint32_t>> groups;
  std::vector<std::vector<std::uint32_t>> clusters;  // numbers of groups

  // Takes the slots out for which leaves(slot) is true, and groups and clusters that have none left.
  void remove(const std::function<bool(std::uint32_t)>& leaves);
};

// Groups of lit surfaces. positions: for every slot with a surface.
PointGroups groups_of(const SurfaceTile& tile, const std::vector<Vec3d>& positions);

// The surface points of a tile, in the form that shadows use.

struct TilePoints {
  std::vector<shadow::Viewpoint> points;  // by slot
  PointGroups groups;
};
// The tile's points, moved off their surfaces. With Terminator::strict, nothing below the horizons of their triangles is visible.
TilePoints points_for_shadows(const SurfaceTile& tile, const RayScene& rays, Terminator terminator);

}  // namespace steradian
