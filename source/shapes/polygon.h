// Polygons as lights.
#pragma once

#include "steradian/polygon_light.h"

namespace steradian::shapes {

// 1 or -1 as the light is seen from the front or the back, 0 where it sends nothing.
inline int lit_side(const PreparedPolygon& light, Vec3d position) {
  const int side = light.side_of(position);
  return side < 0 && !light.two_sided ? 0 : side;
}

}  // namespace steradian::shapes
