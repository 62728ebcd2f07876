// LightFrame, the coordinates of all shadow code.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/body.h"
#include "steradian/polygon_light.h"
#include "steradian/vector.h"

namespace steradian::shadow {

// LightFrame: a flat light as seen from one side of its plane. All of the shadow code uses its coordinates.

// A point of the light's outline, in the plane.
struct Corner {
  double x = 0, y = 0;
};

// origin: centre of the bounding rectangle. x and y run along its sides, z away from the viewer's side. The frame is right-handed, so that
// counter-clockwise is walk order.
struct LightFrame {
  Vec3d origin;
  Frame axes;
  double half_x = 0, half_y = 0;              // half sides of the bounding rectangle
  double box_x = 0, box_y = 0;                // slightly larger: the outline must not touch the sides
  double eta = 0;                             // only geometry with z < -eta blocks
  std::vector<std::vector<Corner>> contours;  // walk order: the light lies on the left
  const Body* body = nullptr;                 // of a round light, which the frame represents for one point
  bool layered = false;                       // the outline may lie on itself: that of a solid light (kLayer of segments.h)

  Vec3d to_local(Vec3d p) const { return axes.to_local(p - origin); }
  Vec3d to_world(Vec3d p) const { return origin + axes.to_world(p); }

  // The way from a point towards a place in the plane, up to where nothing more blocks: just before the plane, or before the body.
  Vec3d way(Vec3d from, Vec3d place) const;
};

// How a point projects vertices whose coordinates are relative to an anchor (shadow_project).
struct Eye {
  Vec3d eye, shift;
  double height;  // only vertices below it block
};
Eye eye_of(const LightFrame& frame, Vec3d anchor, Vec3d point);

// Sets box and eta from the half sides.
void put_box(LightFrame& frame);

// Distance from a light's plane within which nothing blocks. The light's vertices may lie 1e-5 of its size off the plane
// (prepare_polygon), and so may the triangles that represent it.
double margin_of_plane(const PreparedPolygon& light);

// side: +1 as seen from the lit side, -1 from the other. The light must have an area.
LightFrame light_frame(const PreparedPolygon& light, int side);

}  // namespace steradian::shadow
