#include "reference/surface_sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/capsule_light.h"

namespace steradian::reference {
namespace {

using std::numbers::pi;

// From the space in which an ellipsoid is the unit sphere, and back.
Vec3d out_of(const Ellipsoid& e, Vec3d v) { return e.x * v.x + e.y * v.y + e.z * v.z; }
Vec3d into(const Ellipsoid& e, Vec3d v, double determinant) {
  return Vec3d{dot(cross(e.y, e.z), v), dot(cross(e.z, e.x), v), dot(cross(e.x, e.y), v)} / determinant;
}

double area_of(const Capsule& c) { return 2 * pi * c.radius * (length(c.end_b - c.end_a) + 2 * c.radius); }

}  // namespace

SurfaceSampler::SurfaceSampler(const AreaLight& light, Vec3d from) : light_(light), from_(from), body_(Body::of(light.shape)) {
  if (const auto* disk = std::get_if<Ellipse>(&light.shape)) {
    const double height = dot(from - disk->center, cross(disk->x, disk->y));
    sees_ = height > 0 || (height < 0 && light.two_sided);
    return;
  }
  if (!body_) return;
  sees_ = !body_->contains(from);
  const auto* e = std::get_if<Ellipsoid>(&light.shape);
  if (e == nullptr) return;
  determinant_ = dot(cross(e->x, e->y), e->z);
  unit_from_ = into(*e, from - e->center, determinant_);
  const double distance = length(unit_from_);
  sees_ = sees_ && distance > 1;
  if (!sees_) return;
  to_center_ = Frame::from_normal(-unit_from_ / distance);
  const double sine2 = 1 / (distance * distance);
  cap_ = sine2 / (1 + std::sqrt((1 - 1 / distance) * (1 + 1 / distance)));
}

SurfaceSampler::Place SurfaceSampler::at(Vec3d place, Vec3d normal, double area) const {
  const Vec3d to = place - from_;
  const double distance = length(to), facing = std::fabs(dot(to, normal)) / distance;
  if (!(facing > 0)) return {};
  return {to / distance, distance, distance * distance / (area * facing)};
}

// unit: a unit direction in the space in which the ellipsoid is the unit sphere.
SurfaceSampler::Place SurfaceSampler::on_ellipsoid(Vec3d unit) const {
  const double b = dot(unit_from_, unit), d = b * b - dot(unit_from_, unit_from_) + 1;
  const Vec3d to = out_of(std::get<Ellipsoid>(light_.shape), unit);
  const double size = length(to), near = -b - std::sqrt(std::max(d, 0.0));
  return {to / size, near * size, size * size * size / (std::fabs(determinant_) * 2 * pi * cap_)};
}

SurfaceSampler::Place SurfaceSampler::sample(double u, double v) const {
  if (!sees_) return {};
  if (const auto* disk = std::get_if<Ellipse>(&light_.shape)) {
    const double r = std::sqrt(u), angle = 2 * pi * v;
    const Vec3d normal = cross(disk->x, disk->y);
    const double size = length(normal);
    return at(disk->center + disk->x * (r * std::cos(angle)) + disk->y * (r * std::sin(angle)), normal / size, pi * size);
  }
  if (std::holds_alternative<Ellipsoid>(light_.shape)) {
    const double less = cap_ * u, sine = std::sqrt(less * (2 - less)), angle = 2 * pi * v;
    return on_ellipsoid(to_center_.to_world({sine * std::cos(angle), sine * std::sin(angle), 1 - less}));
  }
  const Capsule& c = std::get<Capsule>(light_.shape);
  const double size = length(c.end_b - c.end_a), angle = 2 * pi * v;
  // Along the axis, a ball's surface is as dense as its cylinder's (Archimedes).
  const double along = u * (size + 2 * c.radius) - c.radius;
  const Frame frame = Frame::from_normal(size > 0 ? (c.end_b - c.end_a) / size : Vec3d{0, 0, 1});
  const double beyond = along < 0 ? along : along > size ? along - size : 0;
  const double height = beyond / c.radius, across = std::sqrt(std::max((1 - height) * (1 + height), 0.0));
  const Vec3d normal = frame.to_world({across * std::cos(angle), across * std::sin(angle), height});
  const Vec3d place = c.end_a + frame.z * std::clamp(along, 0.0, size) + normal * c.radius;
  if (!(dot(from_ - place, normal) > 0)) return {};
  return at(place, normal, area_of(c));
}

SurfaceSampler::Place SurfaceSampler::towards(Vec3d direction) const {
  if (!sees_) return {};
  if (const auto* disk = std::get_if<Ellipse>(&light_.shape)) {
    const Vec3d normal = cross(disk->x, disk->y);
    const double size2 = dot(normal, normal), distance = dot(disk->center - from_, normal) / dot(direction, normal);
    if (!(distance > 0) || !std::isfinite(distance)) return {};
    const Vec3d d = from_ + direction * distance - disk->center;
    const double x = dot(cross(d, disk->y), normal) / size2, y = dot(cross(disk->x, d), normal) / size2;
    if (!(x * x + y * y <= 1)) return {};
    return at(from_ + direction * distance, normal / std::sqrt(size2), pi * std::sqrt(size2));
  }
  if (const auto* e = std::get_if<Ellipsoid>(&light_.shape)) {
    const Vec3d unit = normalized(into(*e, direction, determinant_));
    // 1 - cosine by the sine: the cone of a far light is narrow.
    const Vec3d aside = unit - to_center_.z;
    if (!(0.5 * dot(aside, aside) <= cap_)) return {};
    return on_ellipsoid(unit);
  }
  const Capsule& c = std::get<Capsule>(light_.shape);
  const std::optional<Body::Span> span = body_->span(from_, direction);
  if (!span || !(span->enters > 0)) return {};
  const Vec3d place = from_ + direction * span->enters, axis = c.end_b - c.end_a;
  const double size2 = dot(axis, axis), t = size2 > 0 ? std::clamp(dot(place - c.end_a, axis) / size2, 0.0, 1.0) : 0;
  return at(place, (place - c.end_a - axis * t) / c.radius, area_of(c));
}

}  // namespace steradian::reference
