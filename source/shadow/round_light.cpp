#include "shadow/round_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/capsule_light.h"

namespace steradian::shadow {
PreparedPolygon polygon_of_round(const AreaLight& area, Vec3d p, int corners) {
  PolygonLight seen = polygon_seen_from(area, p, corners);
  if (seen.vertices.empty()) return {};
  if (std::holds_alternative<Capsule>(area.shape)) {
    const Capsule& tube = std::get<Capsule>(area.shape);
    const Vec3d center = (tube.end_a + tube.end_b) * 0.5, axis = normalized(tube.end_b - tube.end_a), to = p - center;
    const Vec3d across = to - axis * dot(to, axis);
    const Vec3d near_end = dot(to, axis) > 0 ? tube.end_b : tube.end_a;
    Vec3d through = center, normal = across;
    double distance = length(across);
    if (!(distance > std::sin(20 * std::numbers::pi / 180) * length(p - near_end)) || axis == Vec3d{}) {
      through = near_end;
      normal = p - near_end;
      distance = length(normal);
    }
    if (!(distance > tube.radius)) return {};
    normal = normal / distance;
    through += normal * (tube.radius * tube.radius / distance);
    const double height = dot(through - p, normal);  // negative
    for (Vec3d& v : seen.vertices) {
      const Vec3d d = normalized(v - p);
      v = p + d * (height / std::min(dot(d, normal), -1e-6));
    }
  }
  return prepare_polygon(seen);
}

}  // namespace steradian::shadow
