#include "shadow/region/round_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shadow/edges/edge_arrays.h"
#include "steradian/capsule_light.h"

namespace steradian::shadow {
namespace {

// Radius of the regular polygon that has the unit circle's area.
double regular_polygon_of_equal_area(int corners) {
  const double step = 2 * std::numbers::pi / corners;
  return std::sqrt(step / std::sin(step));
}

}  // namespace

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
    // Beyond an end: the plane across the line of sight to that end. Beside the tube: the plane across that to the axis. The two agree in
    // between.
    const bool beyond = std::fabs(dot(to, axis)) > length(tube.end_b - tube.end_a) / 2;
    if (beyond || axis == Vec3d{}) {
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
      const double down = std::min(dot(d, normal), -1e-6);  // on the plane in spite of rounding
      v = p + (d + normal * (down - dot(d, normal))) * (height / down);
    }
  }
  return prepare_polygon(seen);
}

namespace {

// A segment of a circle: the arc of half_angle on both sides of u, and its chord. Corners on the arc are pushed out to give its area.
std::vector<Vec3d> circle_segment(Vec3d center, Vec3d u, Vec3d v, double half_angle, int corners) {
  const int steps = std::max(4, static_cast<int>(std::ceil(corners * half_angle / std::numbers::pi)));
  const double step = 2 * half_angle / steps, s = std::sin(step);
  const double square = 0.5 * (steps - 2) * s;  // area = square f^2 + s f, for corners at f
  const double out = (std::sqrt(s * s + 4 * square * half_angle) - s) / (2 * square);
  std::vector<Vec3d> points;
  for (int k = 0; k <= steps; ++k) {
    const double angle = k * step - half_angle, f = k == 0 || k == steps ? 1 : out;
    points.push_back(center + u * (f * std::cos(angle)) + v * (f * std::sin(angle)));
  }
  return points;
}

}  // namespace

std::vector<PreparedPolygon> parts_of_tube(const Capsule& tube, Vec3d radiance, Vec3d p, int corners) {
  if (!(distance_to_axis(tube, p) > tube.radius)) return {};
  std::vector<PreparedPolygon> parts;
  const auto add = [&](std::vector<Vec3d> vertices) {
    PolygonLight light;
    light.vertices = std::move(vertices);
    light.radiance = radiance;
    PreparedPolygon part = prepare_polygon(light);
    if (!part.vertices.empty()) parts.push_back(std::move(part));
  };
  const double size = length(tube.end_b - tube.end_a), r = tube.radius;
  const Vec3d axis = size > 0 ? (tube.end_b - tube.end_a) / size : Vec3d{};
  const double along = dot(p - tube.end_a, axis);
  const Vec3d across = p - tube.end_a - axis * along;
  const double distance = length(across);
  // The end at `center`, from which the tube runs against `out`; least: cosine on the circle where the tube goes on.
  const auto add_end = [&](Vec3d center, Vec3d out, bool whole) {
    const double d = length(p - center);
    const Vec3d n = (p - center) / d;
    const double height = r * r / d, radius = r * std::sqrt((1 - r / d) * (1 + r / d));
    const Vec3d flat = out - n * dot(out, n);
    if (whole || !(dot(flat, flat) > 0)) {
      const Frame frame = Frame::from_normal(n);
      add(equal_area_polygon({center + n * height, frame.x * radius, frame.y * radius}, {}, corners).vertices);
      return;
    }
    const Vec3d u = normalized(flat);
    const double cosine = -dot(out, n) * height / (radius * dot(out, u));
    if (cosine >= 1) return;
    add(circle_segment(center + n * height, u * radius, cross(n, u) * radius, std::acos(std::max(cosine, -1.0)), corners));
  };
  if (!(distance > r)) {  // beyond an end, and so near the axis that this end hides the rest
    add_end(along > 0 ? tube.end_b : tube.end_a, axis, true);
    return parts;
  }
  const Vec3d toward = across / distance, side = cross(toward, axis);
  const double height = r * r / distance, width = r * std::sqrt((1 - r / distance) * (1 + r / distance));
  const auto at = [&](Vec3d end, double w) { return end + toward * height + side * w; };
  if (size > 0) add({at(tube.end_a, -width), at(tube.end_b, -width), at(tube.end_b, width), at(tube.end_a, width)});
  add_end(tube.end_a, -axis, size == 0);
  if (size > 0) add_end(tube.end_b, axis, false);
  return parts;
}

std::optional<LightFrame> frame_of_ellipsoid(const Ellipsoid& light, Vec3d position, int corners) {
  const std::optional<Ellipse> seen = silhouette(light, position);
  if (!seen) return {};
  // A circle's axes would depend on rounding alone, and the polygon would turn from point to point.
  const double xx = dot(seen->x, seen->x), yy = dot(seen->y, seen->y), xy = dot(seen->x, seen->y);
  constexpr double kRound = 1e-6;
  const double turn = std::hypot(2 * xy, xx - yy) <= kRound * (xx + yy) ? 0 : 0.5 * std::atan2(2 * xy, xx - yy);
  const Vec3d x = seen->x * std::cos(turn) + seen->y * std::sin(turn), y = seen->y * std::cos(turn) - seen->x * std::sin(turn);
  const Vec3d normal = cross(x, y);
  LightFrame frame;
  frame.origin = seen->center;
  frame.axes.x = normalized(x);
  frame.axes.z = normalized(dot(normal, position - frame.origin) > 0 ? -normal : normal);
  frame.axes.y = cross(frame.axes.z, frame.axes.x);
  const double out = regular_polygon_of_equal_area(corners);
  frame.half_x = out * length(x);
  frame.half_y = out * length(y);
  put_box(frame);
  return frame;
}

std::vector<Corner> contour_of_ellipse(const LightFrame& frame, int corners) {
  thread_local std::vector<Corner> circle;  // used at every point, always with the same number
  if (circle.size() != static_cast<std::size_t>(corners)) {
    circle.clear();
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      circle.push_back({std::cos(angle), std::sin(angle)});
    }
  }
  std::vector<Corner> contour = circle;
  for (Corner& c : contour) c = {frame.half_x * c.x, frame.half_y * c.y};
  return contour;
}

std::vector<Segment> outline_of_ellipse(int corners) {
  LightFrame frame;
  frame.half_x = frame.half_y = 1;
  put_box(frame);
  frame.contours = {contour_of_ellipse(frame, corners)};
  return outline_segments(frame);
}

}  // namespace steradian::shadow
