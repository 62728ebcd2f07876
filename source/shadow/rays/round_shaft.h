// Round lights and groups of points: occluders that may lie between, found before each point uses its own polygon (round_light.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shadow/edges/edges.h"
#include "shadow/region/light_frame.h"
#include "steradian/area_light.h"

namespace steradian::shadow {

struct Ball {
  Vec3d center;
  double radius = 0;
};

// A ball that contains a sphere, ellipsoid or tube.
Ball ball_around(const AreaLight& light);

// Largest distance from the ball's centre that the box of a round light's polygon may reach (round_light.h), for any viewpoint. A sphere's
// polygon lies within the ball, except for its corners. A tube's polygon ends where lines of sight to its far end meet a plane between the
// axis and the point. Beside the tube, that is up to three times as far from the middle as that end.
double reach_of_polygon(const AreaLight& light);

// A frame whose shaft contains a sphere, ellipsoid or tube for all points of a group: a square behind its bounding ball. Returns none if
// the group is too near or too wide for one.
std::optional<LightFrame> frame_behind(const AreaLight& light, const std::vector<Vec3d>& points);

// Triangles whose box meets the box of any such polygon.
std::vector<std::uint32_t> triangles_near(const EdgeMesh& mesh, const AreaLight& light);

}  // namespace steradian::shadow
