// Round lights behind triangles: the flat polygon that stands for one.
#pragma once

#include "steradian/area_light.h"

namespace steradian::shadow {

// The polygon that a point sees of a round light, in a plane close to the light: what stands before the light, and nothing
// else, must stand before the plane. A sphere's is its silhouette; a tube's holds its axis and faces the point, and near its
// axis crosses its nearer ball.
//
//   corners  of equal area: 24 are 4.5e-5 rms off in penumbrae (docs/shadows.md)
//   returns  no vertices where nothing is seen
PreparedPolygon polygon_of_round(const AreaLight& area, Vec3d position, int corners);

}  // namespace steradian::shadow
