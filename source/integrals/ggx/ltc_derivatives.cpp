#include <algorithm>

#include "integrals/ggx/ggx.h"
#include "integrals/ggx/ltc_radiance.h"
#include "integrals/polygon_slopes.h"
#include "integrals/tables/ggx_tables.h"
#include "shapes/polygon.h"
#include "steradian/albedo.h"
#include "steradian/dual.h"
#include "steradian/error.h"
#include "steradian/polygon_derivatives.h"

namespace steradian {

using integrals::to_kernel;
using slopes::BothParts;
using slopes::Factors;
using slopes::factors_of;

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

// Derivatives of both parts, by the vertices.
std::vector<BothParts> ltc_by_vertices(LtcMethod method, const PreparedPolygon& light, int side, const ShadingPoint& at, const Frame& frame,
                                       const Material& m) {
  const auto shading = integrals::shading_from<double>(side, to_kernel<double>(frame.to_local(normalized(at.view))));
  const auto by_vertices = [&](const integrals::LtcLobe<double>& lobe) {
    return slopes::by_edges(light, side, at.position, frame, [&](const auto& a, const auto& b) {
      Kernels<double> k;
      const auto s = k.ltc_edge_slopes(lobe.matrix, a, b);
      const Vec3d by_a = slopes::to_vector(k.ltc_edge_transform_back(lobe.matrix, a, s.normal * s.by_start));
      const Vec3d by_b = slopes::to_vector(k.ltc_edge_transform_back(lobe.matrix, b, s.normal * s.by_end));
      return slopes::EdgeDerivatives{{by_a * lobe.n_a.v, by_a * lobe.f_a.v}, {by_b * lobe.n_a.v, by_b * lobe.f_a.v}};
    });
  };
  std::vector<BothParts> result = by_vertices(ltc_lobe_of<double>(method, m, shading));
  if (method == LtcMethod::fresnel) {
    const std::vector<BothParts> grazing = by_vertices(grazing_lobe_of<double>(m, shading));
    for (std::size_t i = 0; i < result.size(); ++i) result[i].fresnel = grazing[i].plain;
  }
  return result;
}

// The integral of a transformed cosine over a light above the horizon, and its change with the matrix: the outline moves under it.
//
//   change   of m
struct ChangedIntegral {
  double value = 0, slope = 0;
};
ChangedIntegral with_matrix(const PreparedPolygon& light, int side, Vec3d position, const Frame& frame, const Kernels<double>::LtcMatrix& m,
                            const Kernels<double>::LtcMatrix& change) {
  Kernels<double> k;
  struct Corner {
    Kernels<double>::vec3 u, under, moves;  // unit; the motion of `under`
  };
  auto walk = k.ltc_begin();
  double slope = 0;
  integrals::walk_contours(
      light.vertices.data(), light.contours.data(), light.contours.size() - 1,
      [&](const Vec3d& vertex) {
        const auto u = k.polygon_direction(to_kernel<double>(frame.to_local(vertex - position))), under = k.ltc_transform(m, u);
        const auto scale = inversesqrt(max(dot(under, under), k.smallest_square()));
        return Corner{u, under * scale, k.ltc_transform(change, u) * scale};
      },
      [&](const Corner& a, const Corner& b) {
        const auto part = k.ltc_part(m, a.u, b.u, a.under, b.under), lobe_part = k.edge_above_horizon(part.start, part.end);
        walk.lobe = k.polygon_add_part(walk.lobe, lobe_part);
        const auto s = k.ltc_part_slopes(part, lobe_part);
        slope += (dot(s.normal, a.moves) * s.by_start + dot(s.normal, b.moves) * s.by_end).v;
      });
  return {k.ltc_integral(walk, Mask<double>(side < 0)).v, side * slope};
}

// The value and the derivative of numbers that depend on one.
Kernels<double>::LtcMatrix matrix_of(const Kernels<Dual<1>>::LtcMatrix& m, const auto& number) {
  Kernels<double>::LtcMatrix result;
  result.xx = number(m.xx);
  result.xz = number(m.xz);
  result.yy = number(m.yy);
  result.zx = number(m.zx);
  result.zz = number(m.zz);
  return result;
}

bool is_above_horizon(const PreparedPolygon& light, Vec3d position, Vec3d normal) {
  return std::all_of(light.vertices.begin(), light.vertices.end(), [&](Vec3d v) { return dot(v - position, normal) >= 0; });
}

// The change of both parts as the view turns within the frame's plane of x and z, away from z. The horizon moves under the matrix, too.
slopes::PartSlopes ltc_by_slant(LtcMethod method, const PreparedPolygon& light, int side, const ShadingPoint& at, const Frame& frame,
                                const Material& m) {
  using S = Dual<1>;
  const Vec3d view = frame.to_local(normalized(at.view));
  auto moving = to_kernel<S>(view);
  moving.x.v.d[0] = view.z;
  moving.z.v.d[0] = -view.x;
  if (is_above_horizon(light, at.position, frame.z)) {
    const auto value_of = [](const Real<S>& x) { return x.v.v; };
    const auto slope_of = [](const Real<S>& x) { return x.v.d[0]; };
    const auto by_lobe = [&](const integrals::LtcLobe<S>& lobe) {
      const ChangedIntegral c =
          with_matrix(light, side, at.position, frame, matrix_of(lobe.matrix, value_of), matrix_of(lobe.matrix, slope_of));
      return slopes::PartSlopes{slope_of(lobe.n_a) * c.value + value_of(lobe.n_a) * c.slope,
                                slope_of(lobe.f_a) * c.value + value_of(lobe.f_a) * c.slope};
    };
    const auto shading = integrals::shading_from<S>(side, moving);
    slopes::PartSlopes result = by_lobe(ltc_lobe_of<S>(method, m, shading));
    if (method == LtcMethod::fresnel) result.fresnel = by_lobe(grazing_lobe_of<S>(m, shading)).plain;
    return result;
  }
  const auto value =
      ltc_integral(method, m).operator()<S>(integrals::contours_in<S>(light, frame, at.position), integrals::shading_from<S>(side, moving));
  return {value.x.v.d[0], value.y.v.d[0]};
}

}  // namespace

RadianceDerivatives ltc_radiance_derivatives(LtcMethod method, const PreparedPolygon& light, const ShadingPoint& at,
                                             const Material& material) {
  const Material m = with_multiple_scattering(material, at);
  refuse_other_ltc(method, m);
  const int side = dot(at.view, at.normal) > 0 ? shapes::lit_side(light, at.position) : 0;
  if (side == 0) return RadianceDerivatives(light.vertices.size());
  const Frame frame = frame_of_view(normalized(at.normal), normalized(at.view));
  const std::vector<BothParts> by_vertex = ltc_by_vertices(method, light, side, at, frame, m);
  const BothParts turn = slopes::turn_of(light, at.position, by_vertex);
  const BothParts by_view = slopes::view_of_round_lobe(frame.z, normalized(at.view), turn, [&](const Vec3d& across) {
    return ltc_by_slant(method, light, side, at, Frame::from_normal_and_tangent(frame.z, across), m);
  });
  return slopes::gathered(light, at, {}, by_vertex, by_view, factors_of(light.radiance, m));
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

}  // namespace steradian
