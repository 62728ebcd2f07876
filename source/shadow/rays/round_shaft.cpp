#include "shadow/rays/round_shaft.h"

#include <algorithm>
#include <cmath>

namespace steradian::shadow {

Ball ball_around(const AreaLight& area) {
  if (const auto* c = std::get_if<Capsule>(&area.shape)) return {(c->end_a + c->end_b) * 0.5, length(c->end_b - c->end_a) / 2 + c->radius};
  const auto& e = std::get<Ellipsoid>(area.shape);
  const double x2 = dot(e.x, e.x), y2 = dot(e.y, e.y), z2 = dot(e.z, e.z);
  const double skew = std::fabs(dot(e.x, e.y)) + std::fabs(dot(e.y, e.z)) + std::fabs(dot(e.z, e.x));
  const bool right_angles = skew < 1e-6 * (x2 + y2 + z2);
  return {e.center, right_angles ? std::sqrt(std::max({x2, y2, z2})) * (1 + 1e-5) : std::sqrt(x2 + y2 + z2)};
}

std::optional<LightFrame> frame_behind(const AreaLight& light, const std::vector<Vec3d>& points) {
  const Ball ball = ball_around(light);
  const double radius = 1.5 * ball.radius;  // the box around the polygon has corners
  Vec3d middle{};
  for (const Vec3d& p : points) middle += p / static_cast<double>(points.size());
  const Vec3d axis = ball.center - middle;
  const double distance = length(axis);
  if (!(distance > 0)) return std::nullopt;
  double nearest = INFINITY, farthest = 0, spread = 0;
  LightFrame frame;
  frame.axes = Frame::from_normal(axis / distance);
  for (const Vec3d& p : points) {
    const Vec3d d = frame.axes.to_local(ball.center - p);
    nearest = std::min(nearest, length(d));
    farthest = std::max(farthest, length(d));
    spread = std::max(spread, std::hypot(d.x, d.y));
  }
  if (nearest < 1.2 * radius || distance < 2 * spread) return std::nullopt;
  frame.origin = ball.center + frame.axes.z * radius;
  // Tangent cone from the nearest point, at the square's plane, and its tilt for points off the axis.
  const double tangent = radius / std::sqrt(nearest * nearest - radius * radius), tilt = spread / (distance - spread);
  const double half = (farthest + radius) * (tangent * (1 + tilt) * (1 + tilt)) + radius * tilt;
  frame.half_x = frame.half_y = half;
  frame.box_x = frame.box_y = 1.1 * half;
  return frame;
}

double reach_of_polygon(const AreaLight& area) {
  return (std::holds_alternative<Capsule>(area.shape) ? 3.6 : 1.6) * ball_around(area).radius;
}

std::vector<std::uint32_t> triangles_near(const EdgeMesh& mesh, const AreaLight& area) {
  const Ball ball = ball_around(area);
  const double reach = reach_of_polygon(area);
  std::vector<std::uint32_t> result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3d a = mesh.vertices[mesh.triangles[t][0]] - ball.center, b = mesh.vertices[mesh.triangles[t][1]] - ball.center,
                c = mesh.vertices[mesh.triangles[t][2]] - ball.center;
    const auto apart = [&](double x, double y, double z) { return std::min({x, y, z}) > reach || std::max({x, y, z}) < -reach; };
    if (!apart(a.x, b.x, c.x) && !apart(a.y, b.y, c.y) && !apart(a.z, b.z, c.z)) result.push_back(t);
  }
  return result;
}

}  // namespace steradian::shadow
