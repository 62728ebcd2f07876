// The surface points of a tile, in the form that shadows use.
#pragma once

#include <vector>

#include "render/shadow/groups.h"
#include "render/tile/tile.h"
#include "shadow/edges/segments.h"
#include "steradian/render.h"

namespace steradian {

struct TilePoints {
  std::vector<shadow::Viewpoint> points;  // by slot
  PointGroups groups;
};
// The tile's points, moved off their surfaces. With Terminator::strict, nothing below the horizons of their triangles is visible.
TilePoints points_for_shadows(const SurfaceTile& tile, Terminator terminator);

}  // namespace steradian
