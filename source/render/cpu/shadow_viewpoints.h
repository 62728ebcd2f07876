// The surface points of a tile as shadows see them.
#pragma once

#include <vector>

#include "render/cpu/shadow_groups.h"
#include "render/cpu/tile.h"
#include "shadow/segments.h"
#include "steradian/render.h"

namespace steradian {

struct TilePoints {
  std::vector<shadow::Viewpoint> points;  // by slot
  PointGroups groups;
};
// Moved off their surfaces; with Terminator::strict, below the horizons of their triangles nothing is seen.
TilePoints points_for_shadows(const SurfaceTile& tile, Terminator terminator);

}  // namespace steradian
