#include "steradian/capsule_light.h"

#include <algorithm>
#include <cmath>

#include "steradian/error.h"
#include "steradian/kernels.h"

namespace steradian {
namespace {

template <class S>
using Seen = typename Kernels<S>::Capsule;

// The unit is the distance: squares of squares of tiny and huge lights would leave the range of float.
double unit_of(const Capsule& capsule, Vec3d position) {
  const double size = length(capsule.end_a - position) + length(capsule.end_b - position) + capsule.radius;
  return size > 0 ? 1 / size : 0;
}

template <class S>
typename Kernels<S>::vec3 local(const Frame& frame, Vec3d v) {
  const Vec3d l = frame.to_local(v);
  return {l.x, l.y, l.z};
}

template <class S>
Seen<S> seen_from(const Capsule& capsule, Vec3d position, const Frame& frame) {
  const double unit = unit_of(capsule, position);
  return Kernels<S>().capsule_prepare(local<S>(frame, (capsule.end_a - position) * unit),
                                      local<S>(frame, (capsule.end_b - position) * unit), typename Kernels<S>::real(capsule.radius * unit));
}

template <class S>
S irradiance(const Capsule& capsule, Vec3d position, Vec3d normal) {
  // The test is in double: the kernel's own test has float's rounding.
  if (!(distance_to_axis(capsule, position) > capsule.radius)) return S(0);
  return Kernels<S>().capsule_irradiance_vector(seen_from<S>(capsule, position, Frame::from_normal(normal))).z.v;
}

template <class S>
S irradiance_of_line(Vec3d end_a, Vec3d end_b, Vec3d position, Vec3d normal) {
  const double unit = unit_of({end_a, end_b, 0}, position);
  const Frame frame = Frame::from_normal(normal);
  const S e =
      Kernels<S>().line_irradiance_vector(local<S>(frame, (end_a - position) * unit), local<S>(frame, (end_b - position) * unit)).z.v;
  return static_cast<S>(static_cast<double>(e) * unit);
}

Vec3d to_vector(const Kernels<double>::vec3& v) { return {v.x.v, v.y.v, v.z.v}; }

// The direction that is equally far from the outline's two ends along the tube: the whole outline is in front.
Vec3d middle_of(const Seen<double>& c) {
  const auto angle = [&](Kernels<double>::real place) { return std::atan2(place.v, c.height.v); };
  const auto cap = [&](const Kernels<double>::vec3& end) { return std::asin(std::min(c.radius.v / length(to_vector(end)), 1.0)); };
  const double middle = 0.5 * (angle(c.at_a) - cap(c.end_a) + angle(c.at_b) + cap(c.end_b));
  return to_vector(c.toward) * std::cos(middle) + to_vector(c.along) * std::sin(middle);
}

// Projects the corners' directions into one plane across the axis: the outline of a capsule is not flat.
PolygonLight flattened(const std::vector<Vec3d>& corners, Vec3d position, Vec3d axis, double distance) {
  // Least cosine. Near the surface of a long tube its ends are nearly a right angle from the axis, and a corner that was pushed out may lie
  // beyond. Coordinates retain half of their digits.
  constexpr double kLeast = 1e-9;
  PolygonLight light;
  for (auto corner = corners.rbegin(); corner != corners.rend(); ++corner) {  // stored order is the reverse of walk order
    const double along = dot(*corner, axis);
    const Vec3d across = *corner - axis * along;
    light.vertices.push_back(position + (axis + across / std::max(along, kLeast)) * distance);
  }
  return light;
}

}  // namespace

double capsule_irradiance(const Capsule& capsule, Vec3d position, Vec3d normal) { return irradiance<double>(capsule, position, normal); }
float capsule_irradiance_float(const Capsule& capsule, Vec3d position, Vec3d normal) {
  return irradiance<float>(capsule, position, normal);
}
double line_irradiance(Vec3d end_a, Vec3d end_b, Vec3d position, Vec3d normal) {
  return irradiance_of_line<double>(end_a, end_b, position, normal);
}
float line_irradiance_float(Vec3d end_a, Vec3d end_b, Vec3d position, Vec3d normal) {
  return irradiance_of_line<float>(end_a, end_b, position, normal);
}

double distance_to_axis(const Capsule& capsule, Vec3d position) {
  const Vec3d a = capsule.end_a - position, span = capsule.end_b - capsule.end_a;
  const double span2 = dot(span, span);
  const double t = span2 > 0 ? std::clamp(-dot(a, span) / span2, 0.0, 1.0) : 0.0;
  // The distance is computed from the nearer end: from the other, only rounding would remain.
  return t > 0.5 ? length(capsule.end_b - position - span * (1 - t)) : length(a + span * t);
}

double distance_along(const Capsule& capsule, Vec3d origin, Vec3d direction) {
  const Vec3d a = capsule.end_a - origin, span = capsule.end_b - capsule.end_a;
  // Seen along the ray, the segment is a segment of the plane, and the ray the origin of the plane.
  const Vec3d flat_a = a - direction * dot(a, direction), flat_span = span - direction * dot(span, direction);
  const double flat2 = dot(flat_span, flat_span);
  // A ray along the segment is nearest at its nearer end.
  const double t = flat2 > 0 ? std::clamp(-dot(flat_a, flat_span) / flat2, 0.0, 1.0) : dot(span, direction) < 0 ? 1.0 : 0.0;
  return std::max(dot(a + span * t, direction), 0.0);
}

PolygonLight polygon_for_lobe(const Capsule& capsule, Vec3d position, const LobeAxis& lobe, int vertices) {
  if (vertices < 6 || vertices > 2048) throw Error("vertices", "must be from 6 to 2048, here is " + std::to_string(vertices));
  if (!(distance_to_axis(capsule, position) > capsule.radius)) return {};
  Kernels<double> k;
  const auto seen = seen_from<double>(capsule, position, Frame::world());
  const auto fan = k.capsule_fan(seen, {lobe.axis.x, lobe.axis.y, lobe.axis.z}, lobe.width, vertices);
  std::vector<Vec3d> corners;
  for (int i = 0; i < vertices; ++i) corners.push_back(normalized(to_vector(k.capsule_fan_corner(fan, i))));
  return flattened(corners, position, middle_of(seen), distance_to_axis(capsule, position));
}

PolygonLight polygon_of_equal_steps(const Capsule& capsule, Vec3d position, int vertices) {
  return polygon_for_lobe(capsule, position, {{0, 0, 1}, 1e3}, vertices);
}

}  // namespace steradian
