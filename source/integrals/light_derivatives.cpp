#include "integrals/light_derivatives.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "integrals/curved_light.h"
#include "integrals/differences.h"
#include "integrals/polygon_slopes.h"
#include "steradian/capsule_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/error.h"

namespace steradian::methods {
namespace {

// The outline of a light as a polygon that does not change with the lobe.
struct FixedOutline {
  static constexpr int kCorners = 64;
  const AreaLight& light;
  const ShadingPoint& at;
  const LobeAxis& lobe;

  PolygonLight operator()(const Polygon&) const { return flat_polygon(light); }
  PolygonLight operator()(const Ellipse& e) const {
    const double height = dot(at.position - e.center, cross(e.x, e.y));
    if (height > 0) return polygon_for_lobe(e, at.position, lobe, kCorners);
    if (height < 0 && light.two_sided) return polygon_for_lobe({e.center, e.y, e.x}, at.position, lobe, kCorners);
    return {};
  }
  PolygonLight operator()(const Ellipsoid& e) const {
    const std::optional<Ellipse> outline = silhouette(e, at.position);
    return outline ? polygon_for_lobe(*outline, at.position, lobe, kCorners) : PolygonLight{};
  }
  PolygonLight operator()(const Capsule& c) const { return polygon_for_lobe(c, at.position, lobe, kCorners); }
  PolygonLight operator()(const Line&) const { return {}; }
};

PolygonLight fixed_outline(const AreaLight& seen, Vec3d radiance, const ShadingPoint& origin, const LobeAxis& lobe) {
  PolygonLight polygon = std::visit(FixedOutline{seen, origin, lobe}, seen.shape);
  polygon.radiance = radiance;
  return polygon;
}

}  // namespace

double narrowest_width(const Material& m, const ShadingPoint& at) {
  const double width = lobe_axis(m, at).width;
  const bool has_widths = m.brdf == Brdf::ggx || m.brdf == Brdf::beckmann;
  return std::min(1.0, has_widths ? std::min({width, m.alpha_x, m.alpha_y}) : width);
}

namespace {

// fine: by which method the lobe changes, if the row has no derivatives of its own
LightDerivativesOfLobe with_outline(const AreaLight& light, const ShadingPoint& at, const Material& m, const Row& row,
                                    const RadianceOptions& options, const FineMethod& fine) {
  LightDerivativesOfLobe result;
  const auto take = [&](const RadianceDerivatives& d) { result.normal = d.normal, result.view = d.view; };
  if (row.derivatives != nullptr && std::holds_alternative<Polygon>(light.shape)) {
    const RadianceDerivatives d = row.derivatives(flat_polygon(light), at, m, options.quality);
    result.light.by_vector = d.vertices;
    result.light.position = by_position(d);
    take(d);
    return result;
  }
  const LobeAxis lobe = lobe_axis(m, at);
  result.light = outline_derivatives(light, at, lobe, row.density(at, m, options.quality));
  const Vec3d normal = normalized(at.normal), view = normalized(at.view);
  if (m.brdf == Brdf::lambert) {
    result.normal = slopes::by_normal(normal, {}, view, result.light.turn, {});
    return result;
  }
  const AreaLight seen = seen_from(light, at.position);
  const PolygonLight outline = fixed_outline(seen, light.radiance, {{}, at.normal, at.view}, lobe);
  if (outline.vertices.empty()) return result;
  if (row.derivatives != nullptr) {
    take(row.derivatives(outline, {{}, at.normal, at.view}, m, options.quality));
    return result;
  }
  const Row& smooth = resolve(fine.method, m, Precision::double_, fine.quality);
  RadianceOptions in_double = options;
  in_double.precision = Precision::double_;
  in_double.quality = fine.quality;
  const PreparedPolygon fixed = prepare_polygon(outline);
  const auto value = [&](Vec3d n, Vec3d v) { return dot(n, v) > 0 ? smooth.polygon(fixed, {{}, n, v}, m, in_double).radiance : Vec3d{}; };
  const double step = kStep * narrowest_width(m, at);
  result.view = by_direction(at.view, step, [&](Vec3d v) { return value(at.normal, v); });
  result.normal = by_direction(at.normal, step, [&](Vec3d n) { return value(n, at.view); });
  return result;
}

// A turn of the strip about its line changes nothing of first order, since the strip stands across the line of sight. So each end moves the
// two corners beside it.
LightDerivativesOfLobe line_derivatives(const Line& line, Vec3d radiance, const ShadingPoint& at, const Material& m, const Row& row,
                                        const RadianceOptions& options) {
  const ShadingPoint origin = {{}, at.normal, at.view};
  const PolygonLight strip = strip_of_line({line.end_a - at.position, line.end_b - at.position}, radiance, origin, m, Precision::double_);
  LightDerivativesOfLobe result;
  result.light.by_vector.resize(2);
  if (strip.vertices.empty()) return result;
  AreaLight light;
  light.shape = Polygon{strip.vertices, {}};
  light.radiance = strip.radiance;
  // The error of a method's value on so thin a strip changes quickly with the lobe.
  result = with_outline(light, origin, m, row, options, {Method::reference, options.quality});
  const std::vector<OutlineDerivatives::ByChannel> corners = result.light.by_vector;
  result.light.by_vector.resize(2);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    result.light.by_vector[0][channel] = corners[0][channel] + corners[3][channel];
    result.light.by_vector[1][channel] = corners[1][channel] + corners[2][channel];
  }
  return result;
}

}  // namespace

LightDerivativesOfLobe light_derivatives(const AreaLight& light, const ShadingPoint& at, const Material& m, const Row& row,
                                         const RadianceOptions& options) {
  if (row.density == nullptr) throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none by " + row.name, "use auto");
  if (light.emission) throw Error("derivatives", "there are none of a light with a profile", "leave the key out");
  if (const auto* line = std::get_if<Line>(&light.shape)) return line_derivatives(*line, light.radiance, at, m, row, options);
  return with_outline(light, at, m, row, options, fine_method(row.method, options.quality));
}

}  // namespace steradian::methods
