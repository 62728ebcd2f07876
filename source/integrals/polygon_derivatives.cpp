#include "steradian/polygon_derivatives.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrals/differences.h"
#include "integrals/ggx/ggx.h"
#include "integrals/irradiance.h"
#include "integrals/methods.h"
#include "integrals/outline_derivatives.h"
#include "integrals/tables/ggx_tables.h"
#include "lobes/lobe.h"
#include "shapes/polygon.h"
#include "steradian/albedo.h"
#include "steradian/closed_form.h"
#include "steradian/dual.h"
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

// Derivatives by the vertices in walk order, relative to the point.
using integrals::to_kernel;
using VertexDerivatives = std::vector<Vec3d>;

// Derivatives of an integral's two parts (integrals::Part).
struct BothByVertices {
  VertexDerivatives plain, fresnel;
};
struct PartByNormal {
  Vec3d plain, fresnel;
};

// Derivatives of an integral's two parts by the unit directions of an edge's ends, in the frame.
struct EdgeDerivatives {
  Vec3d plain_a, fresnel_a, plain_b, fresnel_b;
};

// Sums over the edges (kernels/integral/slopes.glsl): every edge depends on its two ends alone, and the horizon's arcs on none.
//
//   edge(a, b)  EdgeDerivatives of the unit directions of its ends in the frame
template <class Edge>
BothByVertices by_edges(const PreparedPolygon& light, int side, Vec3d position, const Frame& frame, const Edge& edge) {
  BothByVertices result{VertexDerivatives(light.vertices.size()), VertexDerivatives(light.vertices.size())};
  struct End {
    std::size_t index;
    Kernels<double>::vec3 direction;
    double scale;  // side over distance
  };
  const auto end = [&](const Vec3d& v) {
    const Vec3d local = frame.to_local(v - position);
    return End{static_cast<std::size_t>(&v - light.vertices.data()), Kernels<double>().polygon_direction(to_kernel<double>(local)),
               side / std::max(length(local), 1e-18)};
  };
  integrals::walk_contours(light.vertices.data(), light.contours.data(), light.contours.size() - 1, end, [&](const End& a, const End& b) {
    const EdgeDerivatives d = edge(a.direction, b.direction);
    result.plain[a.index] += frame.to_world(d.plain_a) * a.scale;
    result.fresnel[a.index] += frame.to_world(d.fresnel_a) * a.scale;
    result.plain[b.index] += frame.to_world(d.plain_b) * b.scale;
    result.fresnel[b.index] += frame.to_world(d.fresnel_b) * b.scale;
  });
  return result;
}

Vec3d to_vector(const Kernels<double>::vec3& v) { return {v.x.v, v.y.v, v.z.v}; }

VertexDerivatives irradiance_by_vertices(const PreparedPolygon& light, int side, Vec3d position, const Frame& frame) {
  const auto edge = [](const auto& a, const auto& b) {
    const auto s = Kernels<double>().polygon_edge_slopes(a, b);
    return EdgeDerivatives{to_vector(s.normal * s.by_start), {}, to_vector(s.normal * s.by_end), {}};
  };
  return by_edges(light, side, position, frame, edge).plain;
}

// Derivatives of the lobe's true integral: shadowing and Fresnel count along the edges alone, where they are known. The value is the closed
// form's, whose cubature of both is 0.1 to 0.3 % off.
BothByVertices ggx_by_vertices(const PreparedPolygon& light, int side, const ShadingPoint& at, const Frame& frame, const Material& m,
                               Quality quality) {
  Kernels<double> k;
  const auto view = k.ggx_view(to_kernel<double>(frame.to_local(normalized(at.view))), m.alpha_x, m.alpha_y);
  const double smith = m.shadowing ? 1.0 : 0.0;
  const int nodes = quality == Quality::draft ? 4 : quality == Quality::normal ? 6 : 8, pieces = quality == Quality::high ? 2 : 1;
  return by_edges(light, side, at.position, frame, [&](const auto& a, const auto& b) {
    const auto s = k.ggx_edge_slopes(view, a, b, smith, nodes, pieces);
    return EdgeDerivatives{to_vector(s.normal * s.by_start.x), to_vector(s.normal * s.by_start.y), to_vector(s.normal * s.by_end.x),
                           to_vector(s.normal * s.by_end.y)};
  });
}

// Derivatives of any integral over the whole outline, in walk order, turned back from the frame to the world. Six directions are followed
// at a time.
//
//   side      side from which the light is seen
//   integral  integral.template operator()<S>(outline, shading): an integrals::Part<S>
template <class Integral>
BothByVertices by_vertices(const PreparedPolygon& light, int side, const ShadingPoint& at, const Frame& frame, const Integral& integral) {
  using S = Dual<6>;
  const auto shading = integrals::shading_from<S>(side, to_kernel<S>(frame.to_local(normalized(at.view))));
  std::vector<Vec3d> local;
  for (const Vec3d& v : light.vertices) local.push_back(frame.to_local(v - at.position));
  BothByVertices result;
  for (std::size_t first = 0; first < local.size(); first += 2) {
    const auto direction = [&](const Vec3d& v) {
      const auto i = static_cast<std::size_t>(&v - light.vertices.data());
      auto r = to_kernel<S>(local[i]);
      if (i - first < 2) {  // unsigned: not below first either
        const std::size_t d = 3 * (i - first);
        r.x.v.d[d] = r.y.v.d[d + 1] = r.z.v.d[d + 2] = 1.0;
      }
      return Kernels<S>().polygon_direction(r);
    };
    const auto value = integral.template operator()<S>(integrals::contours_of(light, direction), shading);
    for (std::size_t i = first; i < std::min(first + 2, local.size()); ++i) {
      const auto of_vertex = [&](const auto& d) {
        const std::size_t k = 3 * (i - first);
        return frame.to_world({d[k], d[k + 1], d[k + 2]});
      };
      result.plain.push_back(of_vertex(value.x.v.d));
      result.fresnel.push_back(of_vertex(value.y.v.d));
    }
  }
  return result;
}

VertexDerivatives solid_angle_by_vertices(const PreparedPolygon& light, Vec3d position, int side) {
  const auto solid_angle = [&]<class S>(const auto& outline, const integrals::Shading<S>& shading) {
    integrals::SolidAngle<S> integral(outline.direction(light.vertices.front()));
    return integrate(outline, shading, integral);
  };
  return by_vertices(light, side, {position, {0, 0, 1}, {0, 0, 1}}, Frame::from_normal({0, 0, 1}), solid_angle).plain;
}

// Derivatives by the normal, of the function of n/|n|, with light, point and view fixed: one evaluation, in which the frame turns.
//
//   toward   direction that the frame's x axis follows: the tangent, or the view
template <class Integral>
PartByNormal by_normal(const PreparedPolygon& light, int side, const ShadingPoint& at, Vec3d toward, const Integral& integral) {
  using S = Dual<3>;
  Kernels<S> k;
  auto normal = to_kernel<S>(at.normal);
  normal.x.v.d[0] = normal.y.v.d[1] = normal.z.v.d[2] = 1.0;
  const auto frame = k.frame_from_normal_and_view(k.polygon_direction(normal), to_kernel<S>(toward));
  const auto shading = integrals::shading_from<S>(side, transform_transposed(frame, to_kernel<S>(normalized(at.view))));
  const auto value = integral.template operator()<S>(integrals::contours_in<S>(light, frame, at.position), shading);
  const auto& plain = value.x.v.d;
  const auto& fresnel = value.y.v.d;
  return {{plain[0], plain[1], plain[2]}, {fresnel[0], fresnel[1], fresnel[2]}};
}

// Point and normal move opposite to the vertices: the integral sees only vertices relative to the point, turned into the normal's frame.
LightDerivatives gather(const PolygonLight& stored, const PreparedPolygon& light, Vec3d position, Vec3d normal, double value,
                        const VertexDerivatives& by_vertex) {
  LightDerivatives result;
  result.value = value;
  result.vertices.resize(stored_count(stored));
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  Vec3d moment{};
  for (std::size_t i = 0; i < by_vertex.size(); ++i) {
    const Vec3d derivative = by_vertex[i];
    result.vertices[stored_index[i]] = derivative;
    result.position += -derivative;
    moment += cross(light.vertices[i] - position, derivative);
  }
  result.normal = cross(normal, moment);
  return result;
}

LightDerivatives no_light(const PolygonLight& light) {
  LightDerivatives result;
  result.vertices.resize(stored_count(light));
  return result;
}

}  // namespace

LightDerivatives polygon_irradiance_derivatives(const PolygonLight& stored, Vec3d position, Vec3d normal) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = shapes::lit_side(light, position);
  if (side == 0) return no_light(stored);
  return gather(stored, light, position, normal, polygon_irradiance(light, position, normal),
                irradiance_by_vertices(light, side, position, Frame::from_normal(normal)));
}

LightDerivatives polygon_solid_angle_derivatives(const PolygonLight& stored, Vec3d position) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = shapes::lit_side(light, position);
  if (side == 0) return no_light(stored);
  return gather(stored, light, position, {}, polygon_solid_angle(light, position), solid_angle_by_vertices(light, position, side));
}

namespace {

// The channels of an integral's two parts: factors on the parts, one number a channel.
struct Factors {
  Vec3d plain, fresnel;
  std::array<Vec3d, 3> of(Vec3d p, Vec3d f) const {
    return {p * plain.x + f * fresnel.x, p * plain.y + f * fresnel.y, p * plain.z + f * fresnel.z};
  }
};

Factors factors_of(Vec3d radiance, const Material& m) {
  return m.brdf == Brdf::ggx ? Factors{radiance * m.f0, radiance * (m.f90 - m.f0)} : Factors{radiance * m.albedo, {}};
}

RadianceDerivatives of_channels(const PolygonLight& stored, const PreparedPolygon& light, const BothByVertices& parts,
                                const PartByNormal& normal, const Factors& factors) {
  RadianceDerivatives result(stored_count(stored));
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  for (std::size_t i = 0; i < parts.plain.size(); ++i) result.vertices[stored_index[i]] = factors.of(parts.plain[i], parts.fresnel[i]);
  result.normal = factors.of(normal.plain, normal.fresnel);
  return result;
}

void refuse_other_lobes(const Material& m) {
  if (m.brdf != Brdf::lambert && m.brdf != Brdf::phong && m.brdf != Brdf::ggx)
    throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none", "lambert, phong and ggx have");
}

// Derivative by the normal of the irradiance over pi: the normal turns, or the whole light turns the other way about the point.
PartByNormal lambert_by_normal(const PreparedPolygon& light, const ShadingPoint& at, const VertexDerivatives& by_vertex) {
  Vec3d moment{};
  for (std::size_t i = 0; i < by_vertex.size(); ++i) moment += cross(light.vertices[i] - at.position, by_vertex[i]);
  return {cross(at.normal, moment) / std::numbers::pi, {}};
}

bool sends_nothing(int side, const ShadingPoint& at) { return side == 0 || !(dot(at.view, at.normal) > 0); }

}  // namespace

RadianceDerivatives radiance_derivatives(const PolygonLight& stored, const ShadingPoint& at, const Material& material, Quality quality) {
  const Material m = with_multiple_scattering(material, at);
  refuse_other_lobes(m);
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = shapes::lit_side(light, at.position);
  if (sends_nothing(side, at)) return RadianceDerivatives(stored_count(stored));
  const Factors factors = factors_of(light.radiance, m);
  if (m.brdf == Brdf::ggx) {
    const Frame frame = Frame::from_normal_and_tangent(at.normal, m.tangent);
    RadianceDerivatives result = of_channels(stored, light, ggx_by_vertices(light, side, at, frame, m, quality), {}, factors);
    const Quality fine = methods::fine_method(Method::closed_form, quality).quality;
    const double step = methods::kStep * std::min({m.alpha_x, m.alpha_y, 1.0});
    result.normal = methods::by_direction(normalized(at.normal), step, [&](Vec3d normal) {
      return closed_form_radiance(light, {at.position, normal, at.view}, material, fine);
    });
    return result;
  }
  if (m.brdf == Brdf::phong) {
    RadianceDerivatives result(0);
    result.vertices = outline_derivatives(area_light(stored), at, lobe_axis(m, at), lobe_density(at, m)).by_vector;
    const PhongOptions fine = {Method::exact};
    result.normal = methods::by_direction(normalized(at.normal), methods::kStep * std::min(lobe_axis(m, at).width, 1.0), [&](Vec3d normal) {
      return phong_radiance(light, {at.position, normal, at.view}, m, fine);
    });
    return result;
  }
  const Frame frame = Frame::from_normal(at.normal);
  BothByVertices by_vertex{irradiance_by_vertices(light, side, at.position, frame), VertexDerivatives(light.vertices.size())};
  const PartByNormal normal = lambert_by_normal(light, at, by_vertex.plain);
  for (Vec3d& d : by_vertex.plain) d = d / std::numbers::pi;
  return of_channels(stored, light, by_vertex, normal, factors);
}

LobeDensity lobe_density(const ShadingPoint& at, const Material& material) {
  const Frame frame = Frame::from_normal_and_tangent(at.normal, material.tangent);
  return [lobe = lobes::Lobe(lobes::in_frame(material, frame), frame.to_local(normalized(at.view))), frame](Vec3d direction) {
    return lobe.radiance(lobe.evaluate(frame.to_local(direction)));
  };
}

namespace {

void refuse_other_ltc(LtcMethod method, const Material& m) {
  if (method != LtcMethod::classic && method != LtcMethod::compact && method != LtcMethod::fresnel)
    throw Error("derivatives", "this method of linearly transformed cosines has none", "ltc and ltc-compact have");
  if (!serves(method, m) || m.brdf != Brdf::ggx)
    throw Error("material", "derivatives of linearly transformed cosines serve isotropic ggx with shadowing", "use the method closed-form");
}

// The density of an integral of one lobe.
template <class Integral>
LobeDensity density_of(Integral integral, const ShadingPoint& at, const Frame& frame, const Factors& factors) {
  integral.begin(integrals::shading_from<double>(1, to_kernel<double>(frame.to_local(normalized(at.view)))));
  return [integral, frame, factors](Vec3d direction) -> Vec3d {
    const Vec3d u = frame.to_local(direction);
    if (!(u.z >= 0)) return {};
    const auto part = integral.at(to_kernel<double>(u));
    return factors.plain * part.x.v + factors.fresnel * part.y.v;
  };
}

// Frame with x along the view; any x if the view is the normal, which only rounding distinguishes.
Frame frame_of_view(Vec3d normal, Vec3d view) {
  const Vec3d across = view - normal * dot(normal, view);
  return dot(across, across) > 1e-16 ? Frame::from_normal_and_tangent(normal, view) : Frame::from_normal(normal);
}

// The table is interpolated in S: between its nodes it has derivatives by the view; at the nodes, those of one side.
template <class S>
integrals::LtcLobe<S> ltc_lobe_of(LtcMethod method, const Material& m, const integrals::Shading<S>& shading) {
  const double alpha = std::max(m.alpha_x, kSmallestAlpha);
  return method == LtcMethod::compact ? compact_lobe<S>(ggx_compact_table(), alpha, shading.view.z, shading.view)
                                      : classic_lobe<S>(ggx_classic_table(), alpha, shading.view.z);
}
template <class S>
integrals::Ltc<S> ltc_of(LtcMethod method, const Material& m, const integrals::Shading<S>& shading) {
  return integrals::Ltc<S>(ltc_lobe_of(method, m, shading));
}

// The lobe times (1 - v.h)^5, if it has a table of its own.
template <class S>
integrals::LtcLobe<S> grazing_lobe_of(const Material& m, const integrals::Shading<S>& shading) {
  return classic_lobe<S>(ggx_fresnel_table(), std::max(m.alpha_x, kSmallestAlpha), shading.view.z);
}
template <class S>
integrals::Ltc<S> grazing_ltc_of(const Material& m, const integrals::Shading<S>& shading) {
  return integrals::Ltc<S>(grazing_lobe_of(m, shading));
}

auto ltc_integral(LtcMethod method, const Material& m) {
  return [method, &m]<class S>(const auto& outline, const integrals::Shading<S>& shading) {
    auto ltc = ltc_of<S>(method, m, shading);
    auto part = integrate(outline, shading, ltc);
    if (method == LtcMethod::fresnel) {
      auto grazing = grazing_ltc_of(m, shading);
      part.y = integrate(outline, shading, grazing).x;
    }
    return part;
  };
}

BothByVertices ltc_by_vertices(LtcMethod method, const PreparedPolygon& light, int side, const ShadingPoint& at, const Frame& frame,
                               const Material& m) {
  const auto shading = integrals::shading_from<double>(side, to_kernel<double>(frame.to_local(normalized(at.view))));
  const auto by_vertices = [&](const integrals::LtcLobe<double>& lobe) {
    return by_edges(light, side, at.position, frame, [&](const auto& a, const auto& b) {
      Kernels<double> k;
      const auto s = k.ltc_edge_slopes(lobe.matrix, a, b);
      const Vec3d by_a = to_vector(k.ltc_edge_transform_back(lobe.matrix, s.normal * s.by_start));
      const Vec3d by_b = to_vector(k.ltc_edge_transform_back(lobe.matrix, s.normal * s.by_end));
      return EdgeDerivatives{by_a * lobe.n_a.v, by_a * lobe.f_a.v, by_b * lobe.n_a.v, by_b * lobe.f_a.v};
    });
  };
  BothByVertices result = by_vertices(ltc_lobe_of<double>(method, m, shading));
  if (method == LtcMethod::fresnel) result.fresnel = by_vertices(grazing_lobe_of<double>(m, shading)).plain;
  return result;
}

}  // namespace

RadianceDerivatives ltc_radiance_derivatives(LtcMethod method, const PolygonLight& stored, const ShadingPoint& at,
                                             const Material& material) {
  const Material m = with_multiple_scattering(material, at);
  refuse_other_ltc(method, m);
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = shapes::lit_side(light, at.position);
  if (sends_nothing(side, at)) return RadianceDerivatives(stored_count(stored));
  const Vec3d view = normalized(at.view);
  const auto integral = ltc_integral(method, m);
  const Frame frame = frame_of_view(normalized(at.normal), view);
  return of_channels(stored, light, ltc_by_vertices(method, light, side, at, frame, m), by_normal(light, side, at, view, integral),
                     factors_of(light.radiance, m));
}

LobeDensity ltc_lobe_density(LtcMethod method, const ShadingPoint& at, const Material& material) {
  const Material m = with_multiple_scattering(material, at);
  refuse_other_ltc(method, m);
  if (!(dot(at.view, at.normal) > 0)) return [](Vec3d) { return Vec3d{}; };
  const Vec3d view = normalized(at.view);
  const Frame frame = frame_of_view(normalized(at.normal), view);
  const auto shading = integrals::shading_from<double>(1, to_kernel<double>(frame.to_local(view)));
  const Factors factors = factors_of({1, 1, 1}, m);
  if (method != LtcMethod::fresnel) return density_of(ltc_of<double>(method, m, shading), at, frame, factors);
  return [plain = density_of(ltc_of<double>(method, m, shading), at, frame, {factors.plain, {}}),
          grazing = density_of(grazing_ltc_of<double>(m, shading), at, frame, {factors.fresnel, {}})](Vec3d direction) {
    return plain(direction) + grazing(direction);
  };
}

std::array<Vec3d, 3> by_position(const RadianceDerivatives& by_vertices) {
  std::array<Vec3d, 3> result{};
  for (const auto& vertex : by_vertices.vertices)
    for (std::size_t channel = 0; channel < 3; ++channel) result[channel] += -vertex[channel];
  return result;
}

}  // namespace steradian
