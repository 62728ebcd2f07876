// Round lights before groups of points: what may stand between, before each point looks at its own polygon (round_light.h).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shadow/edges.h"
#include "shadow/light_frame.h"
#include "steradian/area_light.h"

namespace steradian::shadow {

struct Ball {
  Vec3d center;
  double radius = 0;
};

// Holds a sphere, ellipsoid or tube.
Ball ball_around(const AreaLight& light);

// How far from the ball's centre the box of the polygon that stands for a round light may reach (round_light.h), from wherever it is
// seen. That of a sphere lies within it, but for its corners. That of a tube is cut where the sights of its far end meet a plane between
// the axis and the point: alongside it, up to three times as far from the middle as that end.
double reach_of_polygon(const AreaLight& light);

// A frame whose shaft holds a sphere, ellipsoid or tube for all points of a group: a square behind its bounding ball. None where the group
// is too near or too wide for one.
std::optional<LightFrame> frame_behind(const AreaLight& light, const std::vector<Vec3d>& points);

// Triangles whose box meets that of any such polygon.
std::vector<std::uint32_t> triangles_near(const EdgeMesh& mesh, const AreaLight& light);

}  // namespace steradian::shadow
