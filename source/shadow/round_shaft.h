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

// A frame whose shaft holds a sphere, ellipsoid or tube for all points of a group: a square behind its bounding ball. None where the group
// is too near or too wide for one.
std::optional<LightFrame> frame_behind(const AreaLight& light, const std::vector<Vec3d>& points);

// Triangles whose box meets that of the light, enlarged: the polygon's box in its plane reaches beyond the ball.
std::vector<std::uint32_t> triangles_near(const EdgeMesh& mesh, const AreaLight& light);

}  // namespace steradian::shadow
