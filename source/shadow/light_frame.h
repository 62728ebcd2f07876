// LightFrame: a flat light as one side of its plane sees it. All of the shadow code counts in its coordinates.
#pragma once

#include <vector>

#include "steradian/polygon_light.h"

namespace steradian::shadow {

// A point of the light's outline, in the plane.
struct Corner {
  double x = 0, y = 0;
};

// origin: centre of the bounding rectangle. x, y along its sides, z away from the side that looks on: right-handed, so
// that counter-clockwise is walk order.
struct LightFrame {
  Vec3d origin;
  Frame axes;
  double half_x = 0, half_y = 0;              // of the bounding rectangle
  double box_x = 0, box_y = 0;                // a little larger: the outline must not touch the sides
  double eta = 0;                             // only what has z < -eta blocks
  std::vector<std::vector<Corner>> contours;  // walk order: the light lies on the left

  Vec3d to_local(Vec3d p) const { return axes.to_local(p - origin); }
  Vec3d to_world(Vec3d p) const { return origin + axes.to_world(p); }
};

// Puts box and eta about the half sides.
void put_box(LightFrame& frame);

// How close to a light's plane nothing blocks: its vertices may lie 1e-5 of its size off it (prepare_polygon), and so may the
// triangles that stand for it.
double margin_of_plane(const PreparedPolygon& light);

// side: +1 as the lit side sees it, -1 as the other does. The light must have an area.
LightFrame light_frame(const PreparedPolygon& light, int side);

}  // namespace steradian::shadow
