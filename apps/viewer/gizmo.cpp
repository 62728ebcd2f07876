#include "gizmo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace steradian::view {
namespace {

constexpr double kFar = 1e300;  // distance of a handle that is not visible

const Vec3d& axis_of(const Gizmo& gizmo, Handle handle) { return gizmo.axes[handle == Handle::x ? 0 : handle == Handle::y ? 1 : 2]; }

// The position along a line through the origin that is nearest to a ray.
std::optional<double> along_axis(Vec3d origin, Vec3d axis, const Ray& ray) {
  const double c = dot(axis, ray.direction), d = 1 - c * c;
  if (d < 1e-4) return {};  // within half a degree of the axis: a pixel would be metres
  const Vec3d w = ray.origin - origin;
  return (dot(w, axis) - c * dot(w, ray.direction)) / d;
}

constexpr Handle kAxes[] = {Handle::x, Handle::y, Handle::z};

double distance_to_handle(const Gizmo& gizmo, Handle handle, const Camera& camera, Vec2d pointer, double width, double height) {
  const Vec3d axis = axis_of(gizmo, handle);
  if (gizmo.mode != GizmoMode::turn) {
    const auto a = project(camera, gizmo.origin + axis * (0.2 * gizmo.size), width, height);
    const auto b = project(camera, gizmo.origin + axis * gizmo.size, width, height);
    return a && b ? distance_to_segment(pointer, *a, *b) : kFar;
  }
  constexpr int kSegments = 64;
  const Frame frame = Frame::from_normal(axis);
  double nearest = kFar;
  std::optional<Vec2d> last;
  for (int i = 0; i <= kSegments; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSegments;
    const auto here = project(camera, gizmo.origin + (frame.x * std::cos(angle) + frame.y * std::sin(angle)) * gizmo.size, width, height);
    if (last && here) nearest = std::min(nearest, distance_to_segment(pointer, *last, *here));
    last = here;
  }
  return nearest;
}

}  // namespace

std::optional<Vec3d> meets_plane(Vec3d origin, Vec3d normal, const Ray& ray) {
  const double c = dot(normal, ray.direction), t = dot(origin - ray.origin, normal) / c;
  if (std::fabs(c) < 1e-3 || !(t > 0)) return {};
  return ray.origin + ray.direction * t;
}

Gizmo gizmo_at(GizmoMode mode, const Affine& world, const Camera& camera) {
  Gizmo gizmo{mode, world.t};
  const double depth = std::max(-dot(world.t - camera.position, camera.z), 1e-6);
  gizmo.size = 2 * depth * std::tan(camera.yfov / 2) / 7;
  if (mode != GizmoMode::scale) return gizmo;
  gizmo.axes[0] = normalized(world.x);
  gizmo.axes[1] = normalized(world.y);
  gizmo.axes[2] = normalized(world.z);
  return gizmo;
}

Handle handle_at(const Gizmo& gizmo, const Camera& camera, Vec2d pointer, double width, double height, double reach) {
  const auto center = project(camera, gizmo.origin, width, height);
  if (center && gizmo.mode != GizmoMode::turn && std::hypot(pointer.x - center->x, pointer.y - center->y) <= reach) return Handle::free;
  Handle best = Handle::none;
  double nearest = reach;
  for (const Handle handle : kAxes) {
    const double d = distance_to_handle(gizmo, handle, camera, pointer, width, height);
    if (d > nearest) continue;
    nearest = d;
    best = handle;
  }
  return best;
}

std::optional<Vec3d> drag_move(const Gizmo& gizmo, Handle handle, const Camera& camera, const Ray& from, const Ray& to) {
  if (handle == Handle::free) {
    const auto a = meets_plane(gizmo.origin, camera.z, from), b = meets_plane(gizmo.origin, camera.z, to);
    return a && b ? std::optional(*b - *a) : std::nullopt;
  }
  const Vec3d axis = axis_of(gizmo, handle);
  const auto a = along_axis(gizmo.origin, axis, from), b = along_axis(gizmo.origin, axis, to);
  return a && b ? std::optional(axis * (*b - *a)) : std::nullopt;
}

std::optional<Turn> drag_turn(const Gizmo& gizmo, Handle handle, const Camera&, const Ray& from, const Ray& to) {
  const Vec3d axis = axis_of(gizmo, handle);
  const auto a = meets_plane(gizmo.origin, axis, from), b = meets_plane(gizmo.origin, axis, to);
  if (!a || !b) return {};
  const Vec3d u = *a - gizmo.origin, v = *b - gizmo.origin;
  return Turn{axis, std::atan2(dot(axis, cross(u, v)), dot(u, v))};
}

std::optional<Vec3d> drag_scale(const Gizmo& gizmo, Handle handle, const Camera& camera, const Ray& from, const Ray& to) {
  constexpr double kSmallest = 0.01;
  if (handle == Handle::free) {  // to the right and up: larger
    const auto a = meets_plane(gizmo.origin, camera.z, from), b = meets_plane(gizmo.origin, camera.z, to);
    if (!a || !b) return {};
    const double factor = std::max(std::exp2(dot(*b - *a, camera.x + camera.y) / gizmo.size), kSmallest);
    return Vec3d{factor, factor, factor};
  }
  const Vec3d axis = axis_of(gizmo, handle);
  const auto a = along_axis(gizmo.origin, axis, from), b = along_axis(gizmo.origin, axis, to);
  if (!a || !b || std::fabs(*a) < 1e-9) return {};
  const double factor = std::max(*b / *a, kSmallest);
  return Vec3d{handle == Handle::x ? factor : 1, handle == Handle::y ? factor : 1, handle == Handle::z ? factor : 1};
}

}  // namespace steradian::view
