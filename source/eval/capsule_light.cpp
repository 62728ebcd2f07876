#include "eval/capsule_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "eval/outline_answer.h"
#include "eval/point_light.h"
#include "steradian/capsule_light.h"
#include "steradian/error.h"

namespace steradian::eval {
namespace {

constexpr double kPi = 3.14159265358979324;

// The light from the point, in units in which its largest number is 1: no square leaves the range of double. A line's
// radiance times width is per unit of length, too.
CapsuleLight seen_from(const CapsuleLight& light, Vec3d position) {
  CapsuleLight seen = light;
  seen.shape.end_a = light.shape.end_a - position;
  seen.shape.end_b = light.shape.end_b - position;
  double largest = light.shape.radius;
  for (const Vec3d& v : {seen.shape.end_a, seen.shape.end_b})
    largest = std::max({largest, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!std::isfinite(largest)) throw Error("light", "is not finite as seen from the position", "scale the query down");
  if (!(largest > 0)) return seen;
  seen.shape.end_a = seen.shape.end_a / largest;
  seen.shape.end_b = seen.shape.end_b / largest;
  seen.shape.radius /= largest;
  if (seen.shape.radius == 0) seen.radiance = light.radiance / largest;
  return seen;
}

// How the line lies, seen from the origin.
struct Axis {
  double length, distance;  // of the segment
  Vec3d moment;             // nearer end x unit direction: its length is the distance of the endless line
};
Axis axis_of(const Capsule& c) {
  const Vec3d span = c.end_b - c.end_a;
  Axis axis;
  axis.length = length(span);
  axis.distance = distance_to_axis(c, {});
  const Vec3d nearer = length(c.end_a) < length(c.end_b) ? c.end_a : c.end_b;
  axis.moment = axis.length > 0 ? cross(nearer, span / axis.length) : Vec3d{};
  return axis;
}

// The segment as a strip of that half width across the sight; walked the way in which the origin sees its lit side.
PolygonLight strip(const Capsule& c, const Axis& axis, double half_width) {
  const Vec3d aside = normalized(axis.moment) * half_width;
  PolygonLight light;
  light.vertices = {c.end_a + aside, c.end_b + aside, c.end_b - aside, c.end_a - aside};
  return light;
}

//   radiance  times width
LobeAnswer line_answer(const Capsule& c, const Axis& axis, Vec3d radiance, const ShadingPoint& at, const Material& m,
                       const MethodEntry& entry, const MethodOptions& options) {
  // Towards the point nothing of a line is seen.
  if (!(length(axis.moment) > 1e-14 * axis.distance)) return nothing(entry.method);
  if (m.brdf == Brdf::lambert && entry.method == Method::exact)
    return lambert_answer(options.precision == Precision::float_
                              ? static_cast<double>(line_irradiance_float(c.end_a, c.end_b, {}, at.normal))
                              : line_irradiance(c.end_a, c.end_b, {}, at.normal),
                          radiance, m);
  const auto of_half_width = [&](double share) {
    const double half_width = share * axis.distance;
    PolygonLight light = strip(c, axis, half_width);
    light.radiance = radiance / (2 * half_width);
    return entry.polygon(prepare_polygon(light), at, m, options);
  };
  const double share = (options.precision == Precision::float_ ? 0.03 : 1e-3) * std::min(lobe_axis(m, at).width, 1.0);
  LobeAnswer answer = of_half_width(share);
  if (entry.method == Method::reference) {
    const Vec3d change = answer.radiance - of_half_width(2 * share).radiance;
    *answer.bound += std::max({std::fabs(change.x), std::fabs(change.y), std::fabs(change.z)});
  }
  return answer;
}

}  // namespace

LobeAnswer capsule_light_answer(const CapsuleLight& light, const ShadingPoint& there, const Material& m,
                                const MethodEntry& entry, const MethodOptions& options) {
  const CapsuleLight seen = seen_from(light, there.position);
  const Capsule& c = seen.shape;
  const ShadingPoint at = {{}, there.normal, there.view};
  const Axis axis = axis_of(c);
  const bool line = c.radius == 0;
  if (!(axis.distance > c.radius)) return nothing(entry.method);

  // A light of so small a part of its distance is one direction: about its middle, the error is of second order.
  if (axis.length + c.radius < 1e-7 * axis.distance) {
    const Vec3d middle = (c.end_a + c.end_b) * 0.5;
    const double across = axis.length * length(axis.moment) / axis.distance;
    const double area = line ? across : 2 * c.radius * across + kPi * c.radius * c.radius;
    LobeAnswer answer = nothing(entry.method);
    answer.radiance = point_light_radiance({middle, seen.radiance * area}, at, m);
    return answer;
  }
  if (line) return line_answer(c, axis, seen.radiance, at, m, entry, options);
  if (m.brdf == Brdf::lambert && entry.method == Method::exact)
    return lambert_answer(options.precision == Precision::float_
                              ? static_cast<double>(capsule_irradiance_float(c, {}, at.normal))
                              : capsule_irradiance(c, {}, at.normal),
                          seen.radiance, m);
  // The corners of so thin an outline would be rounded to one place.
  if (c.radius < 1e-7 * axis.distance && axis.length > 1e3 * c.radius)
    return line_answer(c, axis, seen.radiance * (2 * c.radius), at, m, entry, options);
  return outline_answer([&](const LobeAxis& lobe, int vertices) { return polygon_for_lobe(c, {}, lobe, vertices); },
                        [&](int vertices) { return polygon_of_equal_steps(c, {}, vertices); }, seen.radiance, at, m, entry,
                        options);
}

}  // namespace steradian::eval
