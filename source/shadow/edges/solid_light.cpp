#include "shadow/edges/solid_light.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace steradian::shadow {
namespace {

// The points of a light must lie at least so high above a plane through a viewer, as a fraction of their distance. The projection stretches
// the light by the inverse.
constexpr double kLeastSeen = 0.02;
// Sides of a box over those of the light's projection from one point, at most. The shadow code measures what is thin by the box.
constexpr double kLoosest = 3;

struct InOrder {
  bool operator()(Vec3d a, Vec3d b) const { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }
};

std::array<Vec3d, 8> corners_of(const Box3d& box) {
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y, (i & 4) != 0 ? box.high.z : box.low.z};
  return corners;
}

// Least height of the light's vertices above the corners along a normal, over their distance.
double height_over_distance(const SolidLight& light, const std::array<Vec3d, 8>& corners, Vec3d normal, double enough) {
  double least = 1;
  for (const Vec3d& v : light.vertices) {
    for (const Vec3d& p : corners) {
      const Vec3d d = v - p;
      const double size = length(d);
      least = std::min(least, size > 0 ? dot(d, normal) / size : 0.0);
    }
    if (least < enough) return least;
  }
  return least;
}

}  // namespace

std::optional<SolidLight> solid_light(const std::vector<std::array<Vec3d, 3>>& triangles, const std::vector<std::uint32_t>& face_of,
                                      std::array<Vec3d, 3> axes) {
  SolidLight light;
  std::map<Vec3d, std::uint32_t, InOrder> numbers;
  const auto number_of = [&](Vec3d p) {
    const auto [place, is_new] = numbers.try_emplace(p + Vec3d{0, 0, 0}, static_cast<std::uint32_t>(light.vertices.size()));
    if (is_new) light.vertices.push_back(p), light.box.add(p);
    return place->second;
  };
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> sides;  // the face of each directed edge
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const std::array<std::uint32_t, 3> corners{number_of(a), number_of(b), number_of(c)};
    for (std::size_t i = 0; i < 3; ++i)
      if (!sides.try_emplace({corners[i], corners[(i + 1) % 3]}, face_of[t]).second) return {};
    if (light.faces.size() <= face_of[t]) light.faces.resize(face_of[t] + 1);
    // The plane of the face's largest triangle is the one that rounding moves least.
    const Vec3d normal = cross(b - a, c - a);
    Plane& plane = light.faces[face_of[t]];
    if (dot(normal, normal) > dot(plane.normal, plane.normal)) plane = {normal, dot(normal, a)};
  }
  for (Plane& plane : light.faces) {
    const double size = length(plane.normal);
    if (!(size > 0)) return {};
    plane = {plane.normal / size, plane.offset / size};
  }
  for (const auto& [side, face] : sides) {
    const auto other = sides.find({side[1], side[0]});
    if (other == sides.end()) return {};
    if (side[0] < side[1] && face != other->second) light.edges.push_back({side[0], side[1], face, other->second});
  }
  const auto extent = [&](Vec3d axis) {
    Interval<double> range;
    for (const Vec3d& v : light.vertices) range.add(dot(v, axis));
    return range.size();
  };
  std::stable_sort(axes.begin(), axes.end(), [&](Vec3d a, Vec3d b) { return extent(a) < extent(b); });
  light.axes = axes;
  return light;
}

namespace {

// The frame whose plane is across a normal and touches the light on the points' side; none if its box would be too loose.
std::optional<LightFrame> frame_across(const SolidLight& light, const std::array<Vec3d, 8>& corners, Vec3d normal) {
  LightFrame frame;
  frame.axes.z = normal;
  const Vec3d along = light.axes[2] - normal * dot(light.axes[2], normal), other = light.axes[1] - normal * dot(light.axes[1], normal);
  frame.axes.x = normalized(dot(along, along) > dot(other, other) ? along : other);
  frame.axes.y = cross(normal, frame.axes.x);
  frame.layered = true;
  Interval<double> heights, x, y;
  for (const Vec3d& v : light.vertices) heights.add(dot(v, normal));
  frame.origin = normal * heights.low;
  // For each vertex, the projection is the quotient of two affine functions of the point: its extremes are at the corners.
  double least_x = INFINITY, least_y = INFINITY;
  for (const Vec3d& corner : corners) {
    const Vec3d eye = frame.to_local(corner);
    Interval<double> own_x, own_y;
    for (const Vec3d& v : light.vertices) {
      const Vec3d local = frame.to_local(v);
      const double t = -eye.z / (local.z - eye.z);
      own_x.add(eye.x + (local.x - eye.x) * t);
      own_y.add(eye.y + (local.y - eye.y) * t);
    }
    for (const double end : {own_x.low, own_x.high}) x.add(end);
    for (const double end : {own_y.low, own_y.high}) y.add(end);
    least_x = std::min(least_x, own_x.size());
    least_y = std::min(least_y, own_y.size());
  }
  if (!(x.size() <= kLoosest * least_x && y.size() <= kLoosest * least_y)) return {};
  frame.origin += frame.axes.x * x.middle() + frame.axes.y * y.middle();
  frame.half_x = x.half();
  frame.half_y = y.half();
  put_box(frame);
  return frame;
}

}  // namespace

std::vector<LightFrame> frames_of(const SolidLight& light, const Box3d& points) {
  const std::array<Vec3d, 8> corners = corners_of(points);
  const Vec3d towards = normalized(light.box.center() - points.center());
  std::vector<LightFrame> frames;
  for (const Vec3d& axis : {light.axes[0], light.axes[1], light.axes[2], towards}) {
    const Vec3d n = dot(axis, towards) < 0 ? -axis : axis;
    if (!(height_over_distance(light, corners, n, kLeastSeen) > kLeastSeen)) continue;
    if (const std::optional<LightFrame> frame = frame_across(light, corners, n)) frames.push_back(*frame);
  }
  return frames;
}

std::vector<bool> triangles_of(const SolidLight& light, const EdgeMesh& mesh) {
  std::set<Vec3d, InOrder> corners(light.vertices.begin(), light.vertices.end());
  std::vector<bool> result;
  for (const auto& t : mesh.triangles)
    result.push_back(std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return corners.contains(mesh.vertices[v]); }));
  return result;
}

std::vector<std::uint32_t> contours_from(const SolidLight& light, const Box3d& points) {
  const Vec3d center = points.center(), half = points.half();
  std::vector<int> facing;  // 1 the front, -1 the back, 0 either
  facing.reserve(light.faces.size());
  const double size = length(half) + length(center - light.box.center()) + light.box.radius();
  for (const Plane& plane : light.faces) {
    const Vec3d n = plane.normal;
    const double middle = dot(n, center) - plane.offset,
                 reach = std::fabs(n.x) * half.x + std::fabs(n.y) * half.y + std::fabs(n.z) * half.z + 4e-6 * size;
    facing.push_back(middle > reach ? 1 : middle < -reach ? -1 : 0);
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t e = 0; e < light.edges.size(); ++e) {
    const int a = facing[light.edges[e].face0], b = facing[light.edges[e].face1];
    if (a * b != 1) result.push_back(e);
  }
  return result;
}

}  // namespace steradian::shadow
