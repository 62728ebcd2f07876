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

// A spot is a connected set of texels brighter than 16 times the median and twice the mean luminance, that carries 0.5 % of the map's
// power. The 16 strongest are cut by great circles into at most 48 convex parts. The part that leaves most light in the rest is cut first,
// until each leaves less than 0.15 % of the map's power, or less than a fifth of its own light. A polygon (at most 16 corners) has the mean
// excess of its part over the texels around the spot. The rest loses exactly the light that the polygons send.
SplitMap split_bright_spots(const DirectionGrid& grid);

}  // namespace steradian::environment
