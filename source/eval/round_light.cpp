#include "eval/round_light.h"

#include <algorithm>
#include <cmath>

#include "eval/outline_answer.h"
#include "eval/point_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/error.h"

namespace steradian::eval {
namespace {

constexpr double kPi = 3.14159265358979324;

// The light from the point, in units in which its largest number is 1: no square leaves the range of double.
RoundLight seen_from(const RoundLight& light, Vec3d position) {
  RoundLight seen = light;
  seen.center = light.center - position;
  double largest = 0;
  for (const Vec3d& v : {seen.center, seen.x, seen.y, seen.z})
    largest = std::max({largest, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!std::isfinite(largest))
    throw Error("light", "is not finite as seen from the position", "scale the query down");
  if (!(largest > 0)) return seen;
  for (Vec3d* v : {&seen.center, &seen.x, &seen.y, &seen.z}) *v = *v / largest;
  return seen;
}

}  // namespace

std::optional<Ellipse> outline_of(const RoundLight& light) {
  if (light.shape == LightShape::sphere) return silhouette(light.center, light.x, light.y, light.z, {});
  const double height = -dot(light.center, cross(light.x, light.y));
  if (height > 0) return Ellipse{light.center, light.x, light.y};
  if (height < 0 && light.two_sided) return Ellipse{light.center, light.y, light.x};
  return {};
}

LobeAnswer round_light_answer(const RoundLight& light, const ShadingPoint& there, const Material& m,
                              const MethodEntry& entry, const MethodOptions& options) {
  const RoundLight seen = seen_from(light, there.position);
  const ShadingPoint at = {{}, there.normal, there.view};
  const std::optional<Ellipse> outline = outline_of(seen);
  if (!outline) return nothing(entry.method);
  if (m.brdf == Brdf::lambert && entry.method == Method::exact)
    return lambert_answer(options.precision == Precision::float_
                              ? static_cast<double>(ellipse_irradiance_float(*outline, {}, at.normal))
                              : ellipse_irradiance(*outline, {}, at.normal),
                          light.radiance, m);

  // A light of a billionth of its distance is one direction; the vertices of its polygon would be rounded to one place.
  if (length(outline->x) + length(outline->y) < 1e-9 * length(outline->center)) {
    const Vec3d projected = cross(outline->x, outline->y) * kPi;
    const double area = -dot(projected, outline->center) / length(outline->center);
    LobeAnswer answer = nothing(entry.method);
    answer.radiance = point_light_radiance({outline->center, light.radiance * area}, at, m);
    return answer;
  }

  return outline_answer([&](const LobeAxis& lobe, int vertices) { return polygon_for_lobe(*outline, {}, lobe, vertices); },
                        [&](int vertices) { return equal_area_polygon(*outline, light.radiance, vertices); }, light.radiance,
                        at, m, entry, options);
}

}  // namespace steradian::eval
