#include "steradian/polygon_derivatives.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrals/ggx/ggx.h"
#include "integrals/irradiance.h"
#include "integrals/phong/phong.h"
#include "integrals/tables/ggx_tables.h"
#include "shapes/polygon.h"
#include "steradian/albedo.h"
#include "steradian/dual.h"
#include "steradian/error.h"

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

// Each edge depends on its two ends alone: six directions an edge, however many vertices there are. Irradiance is the sum of the edges' z
// and of half the angle of the product of their horizon factors. That angle is the sum of their angles.
VertexDerivatives irradiance_by_vertices(const PreparedPolygon& light, Vec3d position, const Frame& frame) {
  using S = Dual<6>;
  using R = Real<S>;
  Kernels<S> k;
  const auto seeded = [](Vec3d v, std::size_t first) {
    Vec3<R> r(v.x, v.y, v.z);
    r.x.v.d[first] = r.y.v.d[first + 1] = r.z.v.d[first + 2] = 1.0;
    return r;
  };
  VertexDerivatives result(light.vertices.size());
  const Vec3d* vertices = light.vertices.data();
  integrals::walk_contours(
      vertices, light.contours.data(), light.contours.size() - 1, [](const Vec3d& v) { return &v; },
      [&](const Vec3d* a, const Vec3d* b) {
        const auto from = k.polygon_direction(seeded(frame.to_local(*a - position), 0));
        const auto to = k.polygon_direction(seeded(frame.to_local(*b - position), 3));
        const auto walk = k.polygon_add_edge(k.polygon_begin(), from, to);
        R term = walk.edges.z;
        if (walk.horizon.x.v.v < 1.0) term += 0.5 * k.trig_atan2(walk.horizon.y, walk.horizon.x);
        const auto& d = term.v.d;
        result[static_cast<std::size_t>(a - vertices)] += frame.to_world({d[0], d[1], d[2]});
        result[static_cast<std::size_t>(b - vertices)] += frame.to_world({d[3], d[4], d[5]});
      });
  return result;
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
// `back` is -1 if the walk ran in reverse.
LightDerivatives gather(const PolygonLight& stored, const PreparedPolygon& light, Vec3d position, Vec3d normal, double value,
                        const VertexDerivatives& by_vertex, double back) {
  LightDerivatives result;
  result.value = value;
  result.vertices.resize(stored_count(stored));
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  Vec3d moment{};
  for (std::size_t i = 0; i < by_vertex.size(); ++i) {
    const Vec3d derivative = by_vertex[i] * back;
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
                irradiance_by_vertices(light, position, Frame::from_normal(normal)), side);
}

LightDerivatives polygon_solid_angle_derivatives(const PolygonLight& stored, Vec3d position) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = shapes::lit_side(light, position);
  if (side == 0) return no_light(stored);
  return gather(stored, light, position, {}, polygon_solid_angle(light, position), solid_angle_by_vertices(light, position, side), 1);
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
  if (m.brdf == Brdf::phong && m.foreshortening)
    throw Error("derivatives", "phong with foreshortening has none", "leave foreshortening out");
}

template <class S>
integrals::Ggx<S> ggx_of(const Material& m, Quality quality) {
  integrals::Ggx<S> ggx;
  ggx.alpha_x = m.alpha_x;
  ggx.alpha_y = m.alpha_y;
  ggx.smith = m.shadowing ? 1.0 : 0.0;
  ggx.quality = quality;
  return ggx;
}

auto ggx_integral(const Material& m, Quality quality) {
  return [&m, quality]<class S>(const auto& outline, const integrals::Shading<S>& shading) {
    auto ggx = ggx_of<S>(m, quality);
    return integrate(outline, shading, ggx);
  };
}

auto phong_integral(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, Quality quality) {
  // The series' bias is a smooth function of the outline. Over a light that is small against the lobe, its derivative is a multiple of the
  // light's. There quadrature is used, where elements replace the light's value (light_elements.glsl: t^3 / 8 below the bias).
  const LightQuarters& q = light.quarters;
  const Vec3d to = q.center - at.position;
  const double deviation = std::sqrt((dot(q.reach_a, q.reach_a) + dot(q.reach_b, q.reach_b)) / (2 * dot(to, to)));
  const double bias = integrals::bias_of(m.exponent, {Method::series, quality});
  const bool small = Kernels<double>().light_elements_power_sharpness(m.exponent).v * deviation < std::cbrt(8 * bias);
  return [&m, quality, small]<class S>(const auto& outline, const integrals::Shading<S>& shading) {
    const integrals::PhongLobe<S> lobe(m.exponent);
    // Only two methods appear here: all of them in dual numbers would exceed the compiler's budget for inlining.
    const auto share = [&](const auto& a, const auto& b, const auto& axis) {
      if (small) return lobe.template share<Method::exact, Quality::normal>(a, b, axis);
      return quality == Quality::high ? lobe.template share<Method::series, Quality::high>(a, b, axis)
                                      : lobe.template share<Method::series, Quality::normal>(a, b, axis);
    };
    integrals::Phong<S, decltype(share)> phong(share, m.exponent, {Method::series, quality});
    return integrate(outline, shading, phong);
  };
}

// Derivative by the normal of the irradiance over pi: the normal turns, or the whole light turns the other way about the point.
PartByNormal lambert_by_normal(const PreparedPolygon& light, int side, const ShadingPoint& at, const VertexDerivatives& by_vertex) {
  Vec3d moment{};
  for (std::size_t i = 0; i < by_vertex.size(); ++i) moment += cross(light.vertices[i] - at.position, by_vertex[i]);
  return {cross(at.normal, moment) * (side / std::numbers::pi), {}};
}

bool sends_nothing(int side, const ShadingPoint& at) { return side == 0 || !(dot(at.view, at.normal) > 0); }

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

}  // namespace

RadianceDerivatives radiance_derivatives(const PolygonLight& stored, const ShadingPoint& at, const Material& material, Quality quality) {
  const Material m = with_multiple_scattering(material, at);
  refuse_other_lobes(m);
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = shapes::lit_side(light, at.position);
  if (sends_nothing(side, at)) return RadianceDerivatives(stored_count(stored));
  const Factors factors = factors_of(light.radiance, m);
  if (m.brdf == Brdf::ggx) {
    const auto integral = ggx_integral(m, quality);
    const Frame frame = Frame::from_normal_and_tangent(at.normal, m.tangent);
    return of_channels(stored, light, by_vertices(light, side, at, frame, integral), by_normal(light, side, at, frame.x, integral),
                       factors);
  }
  const Frame frame = Frame::from_normal(at.normal);
  if (m.brdf == Brdf::phong) {
    const auto integral = phong_integral(light, at, m, quality);
    return of_channels(stored, light, by_vertices(light, side, at, frame, integral), by_normal(light, side, at, frame.x, integral),
                       factors);
  }
  BothByVertices by_vertex{irradiance_by_vertices(light, at.position, frame), VertexDerivatives(light.vertices.size())};
  const PartByNormal normal = lambert_by_normal(light, side, at, by_vertex.plain);
  for (Vec3d& d : by_vertex.plain) d = d * (side / std::numbers::pi);
  return of_channels(stored, light, by_vertex, normal, factors);
}

LobeDensity lobe_density(const ShadingPoint& at, const Material& material) {
  const Material m = with_multiple_scattering(material, at);
  refuse_other_lobes(m);
  if (!(dot(at.view, at.normal) > 0)) return [](Vec3d) { return Vec3d{}; };
  if (m.brdf == Brdf::ggx)
    return density_of(ggx_of<double>(m, Quality::normal), at, Frame::from_normal_and_tangent(at.normal, m.tangent),
                      factors_of({1, 1, 1}, m));
  if (m.brdf == Brdf::phong) {
    const auto none = [](const auto&, const auto&, const auto&) { return Real<double>(0.0); };
    const integrals::Phong<double, decltype(none)> lobe(none, m.exponent, {});
    return density_of(lobe, at, Frame::from_normal(at.normal), factors_of({1, 1, 1}, m));
  }
  return [factor = m.albedo / std::numbers::pi, n = at.normal](Vec3d direction) { return factor * std::max(dot(n, direction), 0.0); };
}

namespace {

void refuse_other_ltc(LtcMethod method, const Material& m) {
  if (method != LtcMethod::classic && method != LtcMethod::compact && method != LtcMethod::fresnel)
    throw Error("derivatives", "this method of linearly transformed cosines has none", "ltc and ltc-compact have");
  if (!serves(method, m) || m.brdf != Brdf::ggx)
    throw Error("material", "derivatives of linearly transformed cosines serve isotropic ggx with shadowing", "use the method closed-form");
}

// Frame with x along the view; any x if the view is the normal, which only rounding distinguishes.
Frame frame_of_view(Vec3d normal, Vec3d view) {
  const Vec3d across = view - normal * dot(normal, view);
  return dot(across, across) > 1e-16 ? Frame::from_normal_and_tangent(normal, view) : Frame::from_normal(normal);
}

// The table is interpolated in S: between its nodes it has derivatives by the view; at the nodes, those of one side.
template <class S>
integrals::Ltc<S> ltc_of(LtcMethod method, const Material& m, const integrals::Shading<S>& shading) {
  const double alpha = std::max(m.alpha_x, kSmallestAlpha);
  return integrals::Ltc<S>(method == LtcMethod::compact ? compact_lobe<S>(ggx_compact_table(), alpha, shading.view.z, shading.view)
                                                        : classic_lobe<S>(ggx_classic_table(), alpha, shading.view.z));
}

// The lobe times (1 - v.h)^5, if it has a table of its own.
template <class S>
integrals::Ltc<S> grazing_ltc_of(const Material& m, const integrals::Shading<S>& shading) {
  return integrals::Ltc<S>(classic_lobe<S>(ggx_fresnel_table(), std::max(m.alpha_x, kSmallestAlpha), shading.view.z));
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
  return of_channels(stored, light, by_vertices(light, side, at, frame, integral), by_normal(light, side, at, view, integral),
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
