#include "shapes/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/capsule_light.h"

namespace steradian {
namespace {

using Span = Body::Span;

Span common(Span a, Span b) { return {std::max(a.enters, b.enters), std::min(a.leaves, b.leaves)}; }
bool is_empty(Span s) { return !(s.enters < s.leaves); }

constexpr Span kNothing{INFINITY, -INFINITY}, kEverything{-INFINITY, INFINITY};

// The part of a line within a distance of the origin: roots of a t^2 + 2 b t + c.
Span roots(double a, double b, double c) {
  if (!(a > 0)) return c < 0 ? kEverything : kNothing;
  const double d = b * b - a * c;
  if (!(d > 0)) return kNothing;
  const double q = -b - std::copysign(std::sqrt(d), b);  // no difference of near numbers
  if (q == 0) return kNothing;
  const double t = q / a, u = c / q;
  return {std::min(t, u), std::max(t, u)};
}

Span of_ball(Vec3d center, double radius, Vec3d origin, Vec3d direction) {
  const Vec3d o = origin - center;
  return roots(dot(direction, direction), dot(o, direction), dot(o, o) - radius * radius);
}

// The part within a cylinder between the planes through its ends.
Span of_cylinder(const Capsule& c, Vec3d origin, Vec3d direction) {
  const double size = length(c.end_b - c.end_a);
  if (!(size > 0)) return kNothing;
  const Vec3d axis = (c.end_b - c.end_a) / size, o = origin - c.end_a;
  const double along = dot(o, axis), speed = dot(direction, axis);
  const Vec3d o_across = o - axis * along, d_across = direction - axis * speed;
  const Span round = roots(dot(d_across, d_across), dot(o_across, d_across), dot(o_across, o_across) - c.radius * c.radius);
  if (speed == 0) return along > 0 && along < size ? round : kNothing;
  const double a = -along / speed, b = (size - along) / speed;
  return common(round, {std::min(a, b), std::max(a, b)});
}

constexpr int kCorners = 96;

std::vector<Vec3d> section_of(const Ellipsoid& e, Vec3d normal, double offset) {
  // In the space in which the ellipsoid is the unit sphere.
  const Vec3d n{dot(normal, e.x), dot(normal, e.y), dot(normal, e.z)};
  const double size = length(n), height = (offset - dot(normal, e.center)) / size;
  if (!(std::fabs(height) < 1)) return {};
  const Frame frame = Frame::from_normal(n / size);
  const double step = 2 * std::numbers::pi / kCorners;
  const double radius = std::sqrt((1 - height) * (1 + height)) * std::sqrt(step / std::sin(step));
  std::vector<Vec3d> corners;
  for (int k = 0; k < kCorners; ++k) {
    const Vec3d v = frame.z * height + frame.x * (radius * std::cos(k * step)) + frame.y * (radius * std::sin(k * step));
    corners.push_back(e.center + e.x * v.x + e.y * v.y + e.z * v.z);
  }
  return corners;
}

std::vector<Vec3d> section_of(const Body& body, const Capsule& c, Vec3d normal, double offset) {
  const double size = length(normal);
  const Vec3d n = normal / size;
  const double height_a = dot(n, c.end_a) - offset / size, height_b = dot(n, c.end_b) - offset / size;
  // A place inside: where the plane cuts the axis, or below the nearer end.
  const double t = (height_a < 0) != (height_b < 0) ? height_a / (height_a - height_b) : std::fabs(height_a) <= std::fabs(height_b) ? 0 : 1;
  const Vec3d nearest = c.end_a + (c.end_b - c.end_a) * t;
  const double height = height_a + (height_b - height_a) * t;
  if (!(std::fabs(height) < c.radius)) return {};
  Vec3d center = nearest - n * height;
  const Vec3d axis = c.end_b - c.end_a, flat = axis - n * dot(n, axis);
  const Frame frame = Frame::from_normal(n);
  const Vec3d x = dot(flat, flat) > 1e-20 * dot(axis, axis) ? normalized(flat) : frame.x, y = cross(n, x);
  const std::optional<Span> along = body.span(center, x), across = body.span(center, y);
  if (!along || !across) return {};
  center += x * (0.5 * (along->enters + along->leaves));
  // Directions are dense towards the ends, as they are on an ellipse of this form.
  const double half_x = 0.5 * (along->leaves - along->enters), half_y = 0.5 * (across->leaves - across->enters);
  std::vector<Vec3d> corners;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2 * std::numbers::pi * k / kCorners;
    const Vec3d d = x * (half_x * std::cos(angle)) + y * (half_y * std::sin(angle));
    const std::optional<Span> s = body.span(center, d);
    if (!s) return {};
    corners.push_back(center + d * s->leaves);
  }
  return corners;
}

}  // namespace

std::optional<Body> Body::of(const Shape& shape) {
  Body body(shape);
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) {
    const double determinant = dot(cross(e->x, e->y), e->z);
    if (!(std::fabs(determinant) > 0)) return {};
    body.rows_[0] = cross(e->y, e->z) / determinant;
    body.rows_[1] = cross(e->z, e->x) / determinant;
    body.rows_[2] = cross(e->x, e->y) / determinant;
    const Vec3d reach{std::hypot(e->x.x, e->y.x, e->z.x), std::hypot(e->x.y, e->y.y, e->z.y), std::hypot(e->x.z, e->y.z, e->z.z)};
    body.box_ = {e->center - reach, e->center + reach};
    return body;
  }
  if (const auto* c = std::get_if<Capsule>(&shape); c != nullptr && c->radius > 0) {
    const Vec3d reach = Box3d::all(c->radius);
    for (const Vec3d& end : {c->end_a, c->end_b}) body.box_.add({end - reach, end + reach});
    return body;
  }
  return {};
}

bool operator==(const Body& a, const Body& b) {
  if (a.shape_.index() != b.shape_.index()) return false;
  if (const auto* c = std::get_if<Capsule>(&a.shape_)) {
    const Capsule& d = std::get<Capsule>(b.shape_);
    return c->end_a == d.end_a && c->end_b == d.end_b && c->radius == d.radius;
  }
  const Ellipsoid &e = std::get<Ellipsoid>(a.shape_), &f = std::get<Ellipsoid>(b.shape_);
  return e.center == f.center && e.x == f.x && e.y == f.y && e.z == f.z;
}

bool Body::contains(Vec3d p) const {
  if (const auto* c = std::get_if<Capsule>(&shape_)) return distance_to_axis(*c, p) < c->radius;
  const Vec3d d = p - std::get<Ellipsoid>(shape_).center, u{dot(rows_[0], d), dot(rows_[1], d), dot(rows_[2], d)};
  return dot(u, u) < 1;
}

std::optional<Body::Span> Body::span(Vec3d origin, Vec3d direction) const {
  Span result = kNothing;
  if (const auto* c = std::get_if<Capsule>(&shape_)) {
    for (const Span part : {of_ball(c->end_a, c->radius, origin, direction), of_ball(c->end_b, c->radius, origin, direction),
                            of_cylinder(*c, origin, direction)})
      if (!is_empty(part)) result = {std::min(result.enters, part.enters), std::max(result.leaves, part.leaves)};
  } else {
    const auto to_unit = [&](Vec3d v) { return Vec3d{dot(rows_[0], v), dot(rows_[1], v), dot(rows_[2], v)}; };
    result = of_ball({}, 1, to_unit(origin - std::get<Ellipsoid>(shape_).center), to_unit(direction));
  }
  if (is_empty(result)) return {};
  return result;
}

std::vector<Vec3d> Body::section(Vec3d normal, double offset) const {
  if (const auto* c = std::get_if<Capsule>(&shape_)) return section_of(*this, *c, normal, offset);
  return section_of(std::get<Ellipsoid>(shape_), normal, offset);
}

}  // namespace steradian
