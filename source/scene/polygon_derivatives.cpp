#include "steradian/polygon_derivatives.h"

#include <algorithm>
#include <numbers>

#include "ggx/clipped_walk.h"
#include "ltc/ggx_tables.h"
#include "moment/phong_lobe.h"
#include "steradian/dual.h"
#include "steradian/albedo.h"
#include "steradian/error.h"

namespace steradian {
namespace {

// Which stored vertex each vertex of the prepared light is: contours lose repeated vertices and may be turned around.
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
      for (std::size_t i = 0; i < kept.size(); ++i)
        result.push_back(offset + kept[turned ? kept.size() - 1 - i : i]);
    }
    offset += contour.size();
  };
  add(light.vertices);
  for (const auto& hole : light.holes) add(hole);
  return result;
}

std::size_t stored_count(const PolygonLight& light) {
  std::size_t count = light.vertices.size();
  for (const auto& hole : light.holes) count += hole.size();
  return count;
}

// By the vertices in walk order, relative to the point.
using VertexDerivatives = std::vector<Vec3d>;

// Each edge depends on its two ends alone: six directions an edge, however many vertices there are. Irradiance is the sum
// of the edges' z and of half the angle of the product of their horizon factors, so of half the sum of their angles.
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
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
    std::size_t a = light.contours[c + 1] - 1;
    for (std::size_t b = light.contours[c]; b < light.contours[c + 1]; a = b++) {
      const auto from = k.polygon_direction(seeded(frame.to_local(light.vertices[a] - position), 0));
      const auto to = k.polygon_direction(seeded(frame.to_local(light.vertices[b] - position), 3));
      const auto walk = k.polygon_add_edge(k.polygon_begin(), from, to);
      R term = walk.edges.z;
      if (walk.horizon.x.v.v < 1.0) term += 0.5 * k.trig_atan2(walk.horizon.y, walk.horizon.x);
      const auto& d = term.v.d;
      result[a] += frame.to_world({d[0], d[1], d[2]});
      result[b] += frame.to_world({d[3], d[4], d[5]});
    }
  }
  return result;
}

// Of any integral over the whole outline, in walk order, in the frame's coordinates turned back to the world's.
//
//   integral  operator()<S>(direction): Real<S>; direction(v) is that of the light's own vertex v, told by its address
template <class Integral>
VertexDerivatives by_vertices(const PreparedPolygon& light, Vec3d position, const Frame& frame, const Integral& integral) {
  std::vector<double> x;
  for (const Vec3d& v : light.vertices) {
    const Vec3d local = frame.to_local(v - position);
    x.insert(x.end(), {local.x, local.y, local.z});
  }
  const Gradient g = gradient(x, [&]<class S>(const std::vector<Real<S>>& coordinates) {
    return integral.template operator()<S>([&](const Vec3d& v) {
      const std::size_t i = 3 * static_cast<std::size_t>(&v - light.vertices.data());
      return Kernels<S>().polygon_direction({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
    });
  });
  VertexDerivatives result;
  for (std::size_t i = 0; i < g.derivative.size(); i += 3)
    result.push_back(frame.to_world({g.derivative[i], g.derivative[i + 1], g.derivative[i + 2]}));
  return result;
}

VertexDerivatives solid_angle_by_vertices(const PreparedPolygon& light, Vec3d position, bool reversed) {
  const auto solid_angle = [&]<class S>(const auto& direction) {
    Kernels<S> k;
    const Vec3d* v = light.vertices.data();
    auto walk = k.solid_angle_begin(direction(v[0]));
    for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
      std::size_t a = light.contours[c + 1] - 1;
      for (std::size_t b = light.contours[c]; b < light.contours[c + 1]; a = b++)
        walk = k.solid_angle_add_edge(walk, direction(v[a]), direction(v[b]));
    }
    return k.solid_angle_finish(walk, Mask<S>(reversed));
  };
  return by_vertices(light, position, Frame::from_normal({0, 0, 1}), solid_angle);
}

VertexDerivatives phong_by_vertices(const PreparedPolygon& light, const ShadingPoint& at, double n, int side,
                                    PhongQuality quality) {
  const Frame frame = Frame::from_normal(at.normal);
  const auto series = [&]<class S>(const auto& direction) {
    Kernels<S> k;
    const PhongLobe<S> lobe(n, 0.0);
    const auto r = k.phong_mirror(to_kernel<S>(frame.to_local(at.view)));
    const Real<S> sum = sum_over_clipped_edges<S>(light, direction, [&](const auto& a, const auto& b) {
      return quality == PhongQuality::high ? lobe.template share<PhongMethod::series, PhongQuality::high>(a, b, r)
                                           : lobe.template share<PhongMethod::series, PhongQuality::normal>(a, b, r);
    });
    return k.moment_phong_radiance(sum, Mask<S>(side < 0));
  };
  return by_vertices(light, at.position, frame, series);
}

// Of one channel with the reflectances f0 and f90, for radiance 1.
VertexDerivatives ggx_by_vertices(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, int side,
                                  Quality quality, double f0, double f90) {
  const Frame frame = Frame::from_normal_and_tangent(at.normal, m.tangent);
  const auto closed_form = [&]<class S>(const auto& direction) {
    Kernels<S> k;
    const auto view = k.ggx_view(to_kernel<S>(frame.to_local(at.view)), m.alpha_x, m.alpha_y);
    std::vector<typename Kernels<S>::ConicArc> edges;
    typename Kernels<S>::vec3 e(0.0, 0.0, 0.0);
    sum_over_clipped_edges<S>(light, direction, [&](const auto& a, const auto& b) {
      edges.push_back(k.ggx_edge(view, a, b));
      e = e + k.conic_vector(edges.back());
      return Real<S>(0.0);
    });
    const Real<S> smith(m.shadowing ? 1.0 : 0.0), facing(side);
    if (quality == Quality::draft) return k.ggx_radiance(k.ggx_draft(view, e, smith, facing), f0, f90);
    auto c = k.ggx_cubature_begin(view, e, smith, facing);
    for (const auto& edge : edges) c = k.ggx_cubature_edge(c, edge, quality == Quality::high ? 2 : 0);
    return k.ggx_radiance(k.ggx_cubature_finish(c), f0, f90);
  };
  return by_vertices(light, at.position, frame, closed_form);
}

// The matrix at a roughness and a view, and what multiplies the integral: table values, constants to the derivatives.
struct LtcLookUp {
  Kernels<double>::LtcMatrix m;
  double n_a, f_a;
};

LtcLookUp look_up_ltc(LtcMethod method, const ShadingPoint& at, const Material& m, const Frame& frame) {
  const double alpha = std::max(m.alpha_x, 1e-4), cosine = dot(frame.z, normalized(at.view));
  LtcLookUp result;
  if (method == LtcMethod::classic) {
    const LtcValue value = ggx_classic_table().look_up(std::sqrt(alpha), cosine);
    const LtcInverse& inverse = value.inverse;
    result.m = {inverse.xx, inverse.xz, inverse.yy, inverse.zx, inverse.zz};
    result.n_a = value.n_a, result.f_a = value.f_a;
  } else {
    const CompactTable::Entry entry = ggx_compact_table().entry(std::sqrt(alpha), cosine);
    result.m = Kernels<double>().ltc_from_compact({entry.shape.e00, entry.shape.e11, entry.shape.e02, entry.shape.e20}, alpha,
                                                  to_kernel<double>(frame.to_local(normalized(at.view))));
    result.n_a = entry.n_a, result.f_a = entry.f_a;
  }
  return result;
}

VertexDerivatives ltc_by_vertices(const PreparedPolygon& light, const ShadingPoint& at, const LtcLookUp& table, int side,
                                  const Frame& frame) {
  const auto integral = [&]<class S>(const auto& direction) {
    Kernels<S> k;
    const typename Kernels<S>::LtcMatrix m = {table.m.xx.v, table.m.xz.v, table.m.yy.v, table.m.zx.v, table.m.zz.v};
    auto walk = k.ltc_begin();
    const Vec3d* v = light.vertices.data();
    for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
      std::size_t i = light.contours[c + 1] - 1;
      for (std::size_t j = light.contours[c]; j < light.contours[c + 1]; i = j++) {
        const auto a = direction(v[i]), b = direction(v[j]);
        walk = k.ltc_add_edge(walk, m, a, b, k.ltc_direction(m, a), k.ltc_direction(m, b));
      }
    }
    return k.ltc_integral(walk, Mask<S>(side < 0));
  };
  return by_vertices(light, at.position, frame, integral);
}

// Point and normal move as the vertices do the other way: the integral sees only vertices relative to the point, turned
// into the normal's frame. `back` is -1 where the walk ran the wrong way round.
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

// +1 or -1 as the light is seen from the front or the back, 0 where it gives no light.
int lit_side(const PreparedPolygon& light, Vec3d position) {
  const int side = light.side_of(position);
  return side < 0 && !light.two_sided ? 0 : side;
}

LightDerivatives no_light(const PolygonLight& light) {
  LightDerivatives result;
  result.vertices.resize(stored_count(light));
  return result;
}

}  // namespace

LightDerivatives polygon_irradiance_derivatives(const PolygonLight& stored, Vec3d position, Vec3d normal) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = lit_side(light, position);
  if (side == 0) return no_light(stored);
  return gather(stored, light, position, normal, polygon_irradiance(light, position, normal),
                irradiance_by_vertices(light, position, Frame::from_normal(normal)), side);
}

LightDerivatives polygon_solid_angle_derivatives(const PolygonLight& stored, Vec3d position) {
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = lit_side(light, position);
  if (side == 0) return no_light(stored);
  return gather(stored, light, position, {}, polygon_solid_angle(light, position),
                solid_angle_by_vertices(light, position, side < 0), 1);
}

RadianceDerivatives radiance_derivatives(const PolygonLight& stored, const ShadingPoint& at, const Material& material,
                                         Quality quality) {
  const Material m = with_multiple_scattering(material, at);
  if (m.brdf != Brdf::lambert && m.brdf != Brdf::phong && m.brdf != Brdf::ggx)
    throw Error("derivatives", std::string("brdf ") + name_of(m.brdf) + " has none", "lambert, phong and ggx have");
  RadianceDerivatives result(stored_count(stored));
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = lit_side(light, at.position);
  if (side == 0 || !(dot(at.view, at.normal) > 0)) return result;
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  const auto add = [&](std::size_t channel, const VertexDerivatives& by_vertex, double scale) {
    for (std::size_t i = 0; i < by_vertex.size(); ++i) result[stored_index[i]][channel] += by_vertex[i] * scale;
  };
  const Vec3d& radiance = light.radiance;
  if (m.brdf == Brdf::ggx) {
    add(0, ggx_by_vertices(light, at, m, side, quality, m.f0.x, m.f90.x), radiance.x);
    add(1, ggx_by_vertices(light, at, m, side, quality, m.f0.y, m.f90.y), radiance.y);
    add(2, ggx_by_vertices(light, at, m, side, quality, m.f0.z, m.f90.z), radiance.z);
    return result;
  }
  const bool lambert = m.brdf == Brdf::lambert;
  const PhongQuality series = quality == Quality::high ? PhongQuality::high : PhongQuality::normal;
  const VertexDerivatives by_vertex =
      lambert ? irradiance_by_vertices(light, at.position, Frame::from_normal(at.normal))
              : phong_by_vertices(light, at, m.exponent, side, series);
  const Vec3d scale = m.albedo * radiance * (lambert ? side / std::numbers::pi : 1.0);
  add(0, by_vertex, scale.x);
  add(1, by_vertex, scale.y);
  add(2, by_vertex, scale.z);
  return result;
}

RadianceDerivatives ltc_radiance_derivatives(LtcMethod method, const PolygonLight& stored, const ShadingPoint& at,
                                             const Material& material) {
  const Material m = with_multiple_scattering(material, at);
  if (method != LtcMethod::classic && method != LtcMethod::compact)
    throw Error("derivatives", "this method of linearly transformed cosines has none", "ltc and ltc-compact have");
  if (!serves(method, m))
    throw Error("material", "linearly transformed cosines serve isotropic ggx with shadowing", "use the method closed-form");
  RadianceDerivatives result(stored_count(stored));
  const PreparedPolygon light = prepare_polygon(stored);
  const int side = lit_side(light, at.position);
  if (side == 0 || !(dot(at.view, at.normal) > 0)) return result;
  const std::vector<std::size_t> stored_index = stored_vertices(stored, light);
  const Frame frame = Frame::from_normal_and_tangent(normalized(at.normal), normalized(at.view));
  const LtcLookUp table = look_up_ltc(method, at, m, frame);
  const VertexDerivatives by_vertex = ltc_by_vertices(light, at, table, side, frame);
  const auto scale = [&](double f0, double f90) {
    return static_cast<double>(Kernels<double>().ltc_specular_scale(f0, f90, table.n_a, table.f_a).v);
  };
  for (std::size_t i = 0; i < by_vertex.size(); ++i)
    result[stored_index[i]] = {by_vertex[i] * (scale(m.f0.x, m.f90.x) * light.radiance.x),
                               by_vertex[i] * (scale(m.f0.y, m.f90.y) * light.radiance.y),
                               by_vertex[i] * (scale(m.f0.z, m.f90.z) * light.radiance.z)};
  return result;
}

std::array<Vec3d, 3> by_position(const RadianceDerivatives& by_vertices) {
  std::array<Vec3d, 3> result{};
  for (const auto& vertex : by_vertices)
    for (std::size_t channel = 0; channel < 3; ++channel) result[channel] += -vertex[channel];
  return result;
}

}  // namespace steradian
