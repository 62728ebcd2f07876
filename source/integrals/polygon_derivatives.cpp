#include "steradian/polygon_derivatives.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrals/differences.h"
#include "integrals/ggx/ggx_derivatives.h"
#include "integrals/methods.h"
#include "integrals/phong/phong_derivatives.h"
#include "lobes/lobe.h"
#include "shapes/polygon.h"
#include "steradian/albedo.h"
#include "steradian/closed_form.h"
#include "steradian/error.h"
#include "steradian/phong.h"

namespace steradian {

std::vector<std::size_t> stored_vertices(const PolygonLight& light, const PreparedPolygon& prepared) {
  std::vector<std::size_t> result;
  std::size_t offset = 0;
  const auto add = [&](const std::vector<Vec3d>& contour) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < contour.size(); ++i)
      if (kept.empty() || !(contour[i] == contour[kept.back()])) kept.push_back(i);
    while (kept.size() > 1 && contour[kept.front()] == contour[kept.back()]) kept.pop_back();
    if (kept.size() >= 3 && result.size() < prepared.vertices.size()) {
      const bool turned = !(prepared.vertices[result.size()] == contour[kept.front()]);
      for (std::size_t i = 0; i < kept.size(); ++i) result.push_back(offset + kept[turned ? kept.size() - 1 - i : i]);
    }
    offset += contour.size();
  };
  add(light.vertices);
  for (const auto& hole : light.holes) add(hole);
  return result;
}

namespace {

std::size_t stored_count(const PolygonLight& light) {
  std::size_t count = light.vertices.size();
  for (const auto& hole : light.holes) count += hole.size();
  return count;
}

using integrals::to_kernel;
using slopes::BothParts;
using slopes::EdgeDerivatives;
using slopes::to_vector;

// By the vertices in walk order: the plain part is the irradiance's, the other one 0.
std::vector<BothParts> irradiance_by_vertices(const PreparedPolygon& light, int side, Vec3d position, Vec3d normal) {
  return slopes::by_edges(light, side, position, Frame::from_normal(normal), [](const auto& a, const auto& b) {
    const auto s = Kernels<double>().polygon_edge_slopes(a, b);
    return EdgeDerivatives{{to_vector(s.normal * s.by_start), {}}, {to_vector(s.normal * s.by_end), {}}};
  });
}

// The density 1 has the integral tan(angle/2) by either end of an edge. The horizon does not clip.
std::vector<BothParts> solid_angle_by_vertices(const PreparedPolygon& light, int side, Vec3d position) {
  return slopes::by_edges(light, side, position, Frame::world(), [](const auto& start, const auto& end) {
    const Vec3d a = to_vector(start), b = to_vector(end);
    const Vec3d by_end = normalized(cross(a, b - a)) * (-length(b - a) / std::max(length(a + b), 1e-18));
    return EdgeDerivatives{{by_end, {}}, {by_end, {}}};
  });
}

// Point and normal move opposite to the vertices: the integral sees only vertices relative to the point, turned into the normal's frame.
LightDerivatives gather(const PreparedPolygon& light, Vec3d position, Vec3d normal, double value, const std::vector<BothParts>& by_vertex) {
  LightDerivatives result;
  result.value = value;
  result.vertices.reserve(by_vertex.size());
  for (const BothParts& derivative : by_vertex) {
    result.vertices.push_back(derivative.plain);
    result.position += -derivative.plain;
  }
  result.normal = cross(normal, slopes::turn_of(light, position, by_vertex).plain);
  return result;
}

LightDerivatives no_light(const PreparedPolygon& light) {
  LightDerivatives result;
  result.vertices.resize(light.vertices.size());
  return result;
}

// The derivatives of a prepared light, in the order of the stored one.
template <class Derivatives, class Vertex = typename decltype(Derivatives::vertices)::value_type>
Derivatives as_stored(const PolygonLight& stored, const PreparedPolygon& light, Derivatives d) {
  std::vector<Vertex> vertices(stored_count(stored));
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  for (std::size_t i = 0; i < stored_index.size(); ++i) vertices[stored_index[i]] = d.vertices[i];
  d.vertices = std::move(vertices);
  return d;
}

}  // namespace

LightDerivatives polygon_irradiance_derivatives(const PreparedPolygon& light, Vec3d position, Vec3d normal) {
  const int side = shapes::lit_side(light, position);
  if (side == 0) return no_light(light);
  return gather(light, position, normal, polygon_irradiance(light, position, normal),
                irradiance_by_vertices(light, side, position, normal));
}
LightDerivatives polygon_irradiance_derivatives(const PolygonLight& stored, Vec3d position, Vec3d normal) {
  const PreparedPolygon light = prepare_polygon(stored);
  return as_stored(stored, light, polygon_irradiance_derivatives(light, position, normal));
}

LightDerivatives polygon_solid_angle_derivatives(const PolygonLight& stored, Vec3d position) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = shapes::lit_side(light, position);
  if (side == 0) return as_stored(stored, light, no_light(light));
  return as_stored(stored, light,
                   gather(light, position, {}, polygon_solid_angle(light, position), solid_angle_by_vertices(light, side, position)));
}

namespace {

void refuse_other_lobes(const Material& m) {
  if (m.brdf != Brdf::lambert && m.brdf != Brdf::phong && m.brdf != Brdf::ggx)
    throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none", "lambert, phong and ggx have");
}

// Sets the derivatives by normal and view to differences of Vec3d value(normal, view).
template <class Value>
void set_differences(RadianceDerivatives& d, const ShadingPoint& at, double width, const Value& value) {
  const double step = methods::kStep * std::min(width, 1.0);
  d.normal = methods::by_direction(normalized(at.normal), step, [&](Vec3d normal) { return value(normal, at.view); });
  d.view = methods::by_direction(normalized(at.view), step, [&](Vec3d view) { return value(at.normal, view); });
}

// Without shadowing, the horizon cuts through the lobe. With multiple scattering, the factor on the lobe changes with the view.
RadianceDerivatives ggx_radiance_derivatives(const PreparedPolygon& light, int side, const ShadingPoint& at, const Material& material,
                                             Quality quality) {
  const Material m = with_multiple_scattering(material, at);
  const slopes::GgxDerivatives d = slopes::ggx_derivatives(light, side, at, m, quality);
  RadianceDerivatives result =
      slopes::gathered(light, at, slopes::felt_tangent(m), d.by_vertex, d.by_view, slopes::factors_of(light.radiance, m));
  if (m.shadowing && !m.multiple_scattering) return result;
  const Quality fine = methods::fine_method(Method::closed_form, quality).quality;
  set_differences(result, at, std::min(m.alpha_x, m.alpha_y), [&](Vec3d normal, Vec3d view) {
    return closed_form_radiance(light, {at.position, normal, view}, material, fine);
  });
  return result;
}

RadianceDerivatives phong_radiance_derivatives(const PreparedPolygon& light, int side, const ShadingPoint& at, const Material& m) {
  const slopes::PhongDerivatives d = slopes::phong_derivatives(light, side, at, m);
  RadianceDerivatives result = slopes::gathered(light, at, {}, d.by_vertex, {d.by_view, {}}, slopes::factors_of(light.radiance, m));
  if (!m.foreshortening) return result;
  const PhongOptions exact = {Method::exact};
  set_differences(result, at, lobe_axis(m, at).width, [&](Vec3d normal, Vec3d view) {
    return phong_radiance(light, {at.position, normal, view}, m, exact);
  });
  return result;
}

}  // namespace

RadianceDerivatives radiance_derivatives(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, Quality quality) {
  refuse_other_lobes(m);
  const int side = dot(at.view, at.normal) > 0 ? shapes::lit_side(light, at.position) : 0;
  if (side == 0) return RadianceDerivatives(light.vertices.size());
  if (m.brdf == Brdf::ggx) return ggx_radiance_derivatives(light, side, at, m, quality);
  if (m.brdf == Brdf::phong) return phong_radiance_derivatives(light, side, at, m);
  const std::vector<BothParts> by_vertex = irradiance_by_vertices(light, side, at.position, normalized(at.normal));
  return slopes::gathered(light, at, {}, by_vertex, {}, {slopes::factors_of(light.radiance, m).plain / std::numbers::pi, {}});
}
RadianceDerivatives radiance_derivatives(const PolygonLight& stored, const ShadingPoint& at, const Material& material, Quality quality) {
  const PreparedPolygon light = prepare_polygon(stored);
  return as_stored(stored, light, radiance_derivatives(light, at, material, quality));
}

RadianceDerivatives ltc_radiance_derivatives(LtcMethod method, const PolygonLight& stored, const ShadingPoint& at,
                                             const Material& material) {
  const PreparedPolygon light = prepare_polygon(stored);
  return as_stored(stored, light, ltc_radiance_derivatives(method, light, at, material));
}

LobeDensity lobe_density(const ShadingPoint& at, const Material& material) {
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  return [lobe = lobes::Lobe(lobes::in_frame(material, frame), frame.to_local(normalized(at.view))), frame](Vec3d direction) {
    return lobe.radiance(lobe.evaluate(frame.to_local(direction)));
  };
}

std::array<Vec3d, 3> by_position(const RadianceDerivatives& by_vertices) {
  std::array<Vec3d, 3> result{};
  for (const auto& vertex : by_vertices.vertices)
    for (std::size_t channel = 0; channel < 3; ++channel) result[channel] += -vertex[channel];
  return result;
}

}  // namespace steradian
