#include "integrals/light_derivatives.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "integrals/curved_light.h"
#include "integrals/differences.h"
#include "steradian/capsule_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/error.h"

namespace steradian::methods {
namespace {

using ByChannel = OutlineDerivatives::ByChannel;

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

PreparedPolygon fixed_outline(const AreaLight& light, const ShadingPoint& at, const LobeAxis& lobe) {
  const AreaLight seen = seen_from(light, at.position);
  const ShadingPoint origin = {{}, at.normal, at.view};
  PolygonLight polygon = std::visit(FixedOutline{seen, origin, lobe}, seen.shape);
  polygon.radiance = light.radiance;
  return polygon.vertices.empty() ? PreparedPolygon{} : prepare_polygon(polygon);
}

}  // namespace

double narrowest_width(const Material& m, const ShadingPoint& at) {
  const double width = lobe_axis(m, at).width;
  const bool has_widths = m.brdf == Brdf::ggx || m.brdf == Brdf::beckmann;
  return std::min(1.0, has_widths ? std::min({width, m.alpha_x, m.alpha_y}) : width);
}

LightDerivativesOfLobe light_derivatives(const AreaLight& light, const ShadingPoint& at, const Material& m, const Row& row,
                                         const RadianceOptions& options) {
  if (row.density == nullptr) throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none by " + row.name, "use auto");
  if (light.emission) throw Error("derivatives", "there are none of a light with a profile", "leave the key out");
  if (std::holds_alternative<Line>(light.shape)) throw Error("derivatives", "a line has no outline", "give the capsule a radius");
  LightDerivativesOfLobe result;
  const LobeAxis lobe = lobe_axis(m, at);
  const bool by_vertices = std::holds_alternative<Polygon>(light.shape) && row.derivatives != nullptr && m.brdf != Brdf::phong;
  if (by_vertices) {
    const PolygonLight polygon = flat_polygon(light);
    const RadianceDerivatives d = row.derivatives(polygon, at, m, options.quality);
    result.light.by_vector = d.vertices;
    result.light.position = by_position(d);
    result.normal = d.normal;
  } else {
    result.light = outline_derivatives(light, at, lobe, row.density(at, m, options.quality));
  }
  const auto perpendicular = [](Vec3d v, Vec3d unit) { return v - unit * dot(v, unit); };
  if (m.brdf == Brdf::lambert) {
    // The lobe turns with the normal: as if the light turned the other way about the point.
    if (!by_vertices)
      for (std::size_t c = 0; c < 3; ++c) result.normal[c] = perpendicular(cross(at.normal, result.light.turn[c]), at.normal);
    return result;
  }
  const FineMethod fine = fine_method(row.method, options.quality);
  const Row& smooth = resolve(fine.method, m, Precision::double_, fine.quality);
  RadianceOptions in_double = options;
  in_double.precision = Precision::double_;
  in_double.quality = fine.quality;
  const PreparedPolygon outline = fixed_outline(light, at, lobe);
  const auto value = [&](Vec3d normal, Vec3d view) {
    return !outline.vertices.empty() && dot(normal, view) > 0 ? smooth.polygon(outline, {{}, normal, view}, m, in_double).radiance
                                                              : Vec3d{};
  };
  const double step = kStep * narrowest_width(m, at);
  result.view = by_direction(at.view, step, [&](Vec3d view) { return value(at.normal, view); });
  if (!by_vertices) result.normal = by_direction(at.normal, step, [&](Vec3d normal) { return value(normal, at.view); });
  return result;
}

}  // namespace steradian::methods
