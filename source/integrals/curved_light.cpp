#include "integrals/curved_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "integrals/methods.h"
#include "integrals/point_light.h"
#include "integrals/textured/profiled_light.h"
#include "steradian/capsule_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/error.h"

namespace steradian::methods {
namespace {

// Calls use(length) with each of a shape's vectors and numbers, relative to the position.
void each_length(Polygon& polygon, Vec3d position, auto use) {
  const auto each = [&](std::vector<Vec3d>& contour) {
    for (Vec3d& v : contour) v = v - position, use(v);
  };
  each(polygon.vertices);
  for (std::vector<Vec3d>& hole : polygon.holes) each(hole);
}
void each_length(Ellipse& e, Vec3d position, auto use) {
  e.center = e.center - position;
  use(e.center), use(e.x), use(e.y);
}
void each_length(Ellipsoid& e, Vec3d position, auto use) {
  e.center = e.center - position;
  use(e.center), use(e.x), use(e.y), use(e.z);
}
void each_length(Capsule& c, Vec3d position, auto use) {
  c.end_a = c.end_a - position;
  c.end_b = c.end_b - position;
  use(c.end_a), use(c.end_b), use(c.radius);
}
void each_length(Line& l, Vec3d position, auto use) {
  l.end_a = l.end_a - position;
  l.end_b = l.end_b - position;
  use(l.end_a), use(l.end_b);
}

double largest_of(Vec3d v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }
double largest_of(double x) { return std::fabs(x); }

bool is_exact_lambert(const Material& m, const Row& entry) { return m.brdf == Brdf::lambert && entry.method == Method::exact; }

double in_precision(const RadianceOptions& options, auto in_double, auto in_float) {
  return options.precision == Precision::float_ ? static_cast<double>(in_float()) : in_double();
}

// A light of a billionth of its distance is one direction; the vertices of its polygon would round to one place.
RadianceResult small_answer(Vec3d place, Vec3d intensity, const ShadingPoint& at, const Material& m, const Row& entry,
                            const RadianceOptions& options) {
  RadianceResult answer = nothing(entry.method);
  answer.radiance = point_light_radiance({place, intensity}, at, m, entry, options);
  return answer;
}

// Answer for the ellipse as seen from the origin, with x cross y towards it.
RadianceResult ellipse_answer(const Ellipse& outline, Vec3d radiance, const ShadingPoint& at, const Material& m, const Row& entry,
                              const RadianceOptions& options) {
  if (is_exact_lambert(m, entry))
    return lambert_answer(in_precision(
                              options, [&] { return ellipse_irradiance(outline, {}, at.normal); },
                              [&] { return ellipse_irradiance_float(outline, {}, at.normal); }),
                          radiance, m);
  if (length(outline.x) + length(outline.y) < 1e-9 * length(outline.center)) {
    const double area = -dot(cross(outline.x, outline.y) * std::numbers::pi, outline.center) / length(outline.center);
    return small_answer(outline.center, radiance * area, at, m, entry, options);
  }
  return outline_answer([&](const LobeAxis& lobe, int vertices) { return polygon_for_lobe(outline, {}, lobe, vertices); },
                        [&](int vertices) { return equal_area_polygon(outline, radiance, vertices); }, radiance, at, m, entry, options);
}

// Position of the line relative to the origin.
struct SegmentAxis {
  double length, distance;  // of the segment
  Vec3d moment;             // nearer end x unit direction: its length is the distance of the endless line
};
SegmentAxis axis_of(const Capsule& c) {
  const Vec3d span = c.end_b - c.end_a;
  SegmentAxis axis;
  axis.length = length(span);
  axis.distance = distance_to_axis(c, {});
  const Vec3d nearer = length(c.end_a) < length(c.end_b) ? c.end_a : c.end_b;
  axis.moment = axis.length > 0 ? cross(nearer, span / axis.length) : Vec3d{};
  return axis;
}

// The segment as a strip of that half width across the line of sight, in walk order from the lit side.
PolygonLight strip(const Capsule& c, const SegmentAxis& axis, double half_width) {
  const Vec3d aside = normalized(axis.moment) * half_width;
  PolygonLight light;
  light.vertices = {c.end_a + aside, c.end_b + aside, c.end_b - aside, c.end_a - aside};
  return light;
}

// Half width of the strip over the distance.
double share_of_strip(const Material& m, const ShadingPoint& at, Precision precision) {
  return (precision == Precision::float_ ? 0.03 : 1e-3) * std::min(lobe_axis(m, at).width, 1.0);
}

//   radiance  times width
RadianceResult thin_answer(const Capsule& c, const SegmentAxis& axis, Vec3d radiance, const ShadingPoint& at, const Material& m,
                           const Row& entry, const RadianceOptions& options) {
  // A line towards the point is not visible.
  if (!(length(axis.moment) > 1e-14 * axis.distance)) return nothing(entry.method);
  if (is_exact_lambert(m, entry))
    return lambert_answer(in_precision(
                              options, [&] { return line_irradiance(c.end_a, c.end_b, {}, at.normal); },
                              [&] { return line_irradiance_float(c.end_a, c.end_b, {}, at.normal); }),
                          radiance, m);
  const auto of_half_width = [&](double share) {
    const double half_width = share * axis.distance;
    PolygonLight light = strip(c, axis, half_width);
    light.radiance = radiance / (2 * half_width);
    return entry.polygon(prepare_polygon(light), at, m, options);
  };
  const double share = share_of_strip(m, at, options.precision);
  RadianceResult answer = of_half_width(share);
  if (entry.method == Method::reference) {
    const Vec3d change = answer.radiance - of_half_width(2 * share).radiance;
    *answer.bound += std::max({std::fabs(change.x), std::fabs(change.y), std::fabs(change.z)});
  }
  return answer;
}

// Answers for each of the shapes, relative to the origin.
struct AnswerOfShape {
  const AreaLight& light;
  const ShadingPoint& at;
  const Material& m;
  const Row& entry;
  const RadianceOptions& options;

  RadianceResult operator()(const Polygon&) const { return entry.polygon(prepare_polygon(flat_polygon(light)), at, m, options); }

  RadianceResult operator()(const Ellipse& e) const {
    const double height = -dot(e.center, cross(e.x, e.y));
    if (height > 0) return ellipse_answer(e, light.radiance, at, m, entry, options);
    if (height < 0 && light.two_sided) return ellipse_answer({e.center, e.y, e.x}, light.radiance, at, m, entry, options);
    return nothing(entry.method);
  }

  RadianceResult operator()(const Ellipsoid& e) const {
    const std::optional<Ellipse> outline = silhouette(e, {});
    return outline ? ellipse_answer(*outline, light.radiance, at, m, entry, options) : nothing(entry.method);
  }

  RadianceResult operator()(const Line& line) const {
    const Capsule c = {line.end_a, line.end_b, 0};
    const SegmentAxis axis = axis_of(c);
    if (!(axis.distance > 0)) return nothing(entry.method);
    if (is_small(c, axis)) return small_answer(middle(c), light.radiance * across(axis), at, m, entry, options);
    return thin_answer(c, axis, light.radiance, at, m, entry, options);
  }

  RadianceResult operator()(const Capsule& c) const {
    const SegmentAxis axis = axis_of(c);
    if (!(axis.distance > c.radius)) return nothing(entry.method);
    if (is_small(c, axis))
      return small_answer(middle(c), light.radiance * (2 * c.radius * across(axis) + std::numbers::pi * c.radius * c.radius), at, m, entry,
                          options);
    if (is_exact_lambert(m, entry))
      return lambert_answer(
          in_precision(
              options, [&] { return capsule_irradiance(c, {}, at.normal); }, [&] { return capsule_irradiance_float(c, {}, at.normal); }),
          light.radiance, m);
    // The corners of such a thin outline would round to one place.
    if (c.radius < 1e-7 * axis.distance && axis.length > 1e3 * c.radius)
      return thin_answer(c, axis, light.radiance * (2 * c.radius), at, m, entry, options);
    return outline_answer([&](const LobeAxis& lobe, int vertices) { return polygon_for_lobe(c, {}, lobe, vertices); },
                          [&](int vertices) { return polygon_of_equal_steps(c, {}, vertices); }, light.radiance, at, m, entry, options);
  }

 private:
  // About the capsule's middle, the error is of second order.
  static bool is_small(const Capsule& c, const SegmentAxis& axis) { return axis.length + c.radius < 1e-7 * axis.distance; }
  static Vec3d middle(const Capsule& c) { return (c.end_a + c.end_b) * 0.5; }
  static double across(const SegmentAxis& axis) { return axis.length * length(axis.moment) / axis.distance; }
};

}  // namespace

PolygonLight strip_of_line(const Line& line, Vec3d radiance, const ShadingPoint& at, const Material& m, Precision precision) {
  const Capsule c = {line.end_a, line.end_b, 0};
  const SegmentAxis axis = axis_of(c);
  if (!(length(axis.moment) > 1e-14 * axis.distance)) return {};
  const double half_width = share_of_strip(m, at, precision) * axis.distance;
  PolygonLight light = strip(c, axis, half_width);
  light.radiance = radiance / (2 * half_width);
  return light;
}

AreaLight seen_from(const AreaLight& light, Vec3d position, double* unit) {
  AreaLight seen = light;
  double largest = 0;
  bool finite = true;
  std::visit(
      [&](auto& shape) {
        each_length(shape, position, [&](const auto& x) {
          finite &= std::isfinite(largest_of(x));
          largest = std::max(largest, largest_of(x));
        });
      },
      seen.shape);
  if (!finite) throw Error("light", "is not finite as seen from the position", "scale the query down");
  if (!(largest > 0)) return seen;
  if (unit != nullptr) *unit = largest;
  std::visit([&](auto& shape) { each_length(shape, {}, [&](auto& x) { x = x / largest; }); }, seen.shape);
  if (std::holds_alternative<Line>(seen.shape)) seen.radiance = light.radiance / largest;
  return seen;
}

RadianceResult curved_light_answer(const AreaLight& light, const ShadingPoint& there, const Material& m, const Row& entry,
                                   const RadianceOptions& options) {
  if (light.emission) return profiled_light_answer(light, there, m, entry, options);
  const AreaLight seen = seen_from(light, there.position);
  const ShadingPoint at = {{}, there.normal, there.view};
  return std::visit(AnswerOfShape{seen, at, m, entry, options}, seen.shape);
}

}  // namespace steradian::methods
