// Bright spots of an environment's map, the sun or a window, as polygon lights: closed forms and shadows apply to those.
#pragma once

#include <vector>

#include "render/environment/direction_grid.h"
#include "steradian/scene.h"

namespace steradian::environment {

struct SplitMap {
  DirectionGrid rest;               // the map without the polygons, negative in places: both together are the map
  std::vector<PolygonLight> spots;  // vertices are directions: points of a plane that touches the unit sphere, lit towards its centre
  double share = 0;                 // fraction of the map's power (luminance) that the spots carry
};

// A spot is a connected set of texels brighter than 16 times the median and twice the mean luminance. It covers at most 0.5 sr, fills 60 %
// of its convex hull and carries 0.5 % of the map's power; only the 16 strongest count. The polygon is the hull of its texels' corners (at
// most 16 corners). Its radiance is the spot's excess over the texels around it.
SplitMap split_bright_spots(const DirectionGrid& grid);

}  // namespace steradian::environment
