#include "shadow/round_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/capsule_light.h"

namespace steradian::shadow {
namespace {

PolygonLight seen_from(const AreaLight& area, Vec3d p, int corners) {
  if (area.shape != LightShape::disk) return polygon_seen_from(area, p, corners);
  PolygonLight light = equal_area_polygon({area.center, area.x, area.y}, area.polygon.radiance, corners);
  light.two_sided = area.polygon.two_sided;
  return light;
}

}  // namespace

PreparedPolygon polygon_of_round(const AreaLight& area, Vec3d p, int corners) {
  PolygonLight seen = seen_from(area, p, corners);
  if (seen.vertices.empty()) return {};
  if (area.shape == LightShape::capsule) {
    const Capsule tube = capsule_of(area);
    const Vec3d axis = normalized(tube.end_b - tube.end_a), to = p - area.center;
    const Vec3d across = to - axis * dot(to, axis);
    const Vec3d near_end = dot(to, axis) > 0 ? tube.end_b : tube.end_a;
    Vec3d through = area.center, normal = across;
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
