// The radiance of a light as derivatives need it: integrals of what a point sees, in any arithmetic.
//
//   operator()<S>(direction, view): the integral for radiance 1, without Fresnel in x and times (1 - v.h)^5 in y, so that a
//   channel is f0 (x - y) + f90 y. direction(v) is the unit direction of the light's own
//   vertex v, view the unit view, both in the shading frame: x as `toward` says, z the normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "ggx/clipped_walk.h"
#include "ltc/ggx_tables.h"
#include "moment/phong_lobe.h"
#include "steradian/ltc.h"

namespace steradian {

struct PhongSeries {
  const PreparedPolygon& light;
  int side;
  double exponent;
  PhongQuality quality;

  template <class S, class Direction>
  typename Kernels<S>::vec2 operator()(const Direction& direction, const Vec3<Real<S>>& view) const {
    Kernels<S> k;
    const PhongLobe<S> lobe(exponent, 0.0);
    const auto r = k.phong_mirror(view);
    const Real<S> sum = sum_over_clipped_edges<S>(light, direction, [&](const auto& a, const auto& b) {
      return quality == PhongQuality::high ? lobe.template share<PhongMethod::series, PhongQuality::high>(a, b, r)
                                           : lobe.template share<PhongMethod::series, PhongQuality::normal>(a, b, r);
    });
    return {k.moment_phong_radiance(sum, Mask<S>(side < 0)), Real<S>(0.0)};
  }
};

struct GgxClosedForm {
  const PreparedPolygon& light;
  int side;
  const Material& material;
  Quality quality;

  template <class S, class Direction>
  typename Kernels<S>::vec2 operator()(const Direction& direction, const Vec3<Real<S>>& view) const {
    Kernels<S> k;
    const auto lobe = k.ggx_view(view, material.alpha_x, material.alpha_y);
    std::vector<typename Kernels<S>::ConicArc> edges;
    typename Kernels<S>::vec3 e(0.0, 0.0, 0.0);
    sum_over_clipped_edges<S>(light, direction, [&](const auto& a, const auto& b) {
      edges.push_back(k.ggx_edge(lobe, a, b));
      e = e + k.conic_vector(edges.back());
      return Real<S>(0.0);
    });
    const Real<S> smith(material.shadowing ? 1.0 : 0.0), facing(side);
    if (quality == Quality::draft) return k.ggx_draft(lobe, e, smith, facing);
    auto c = k.ggx_cubature_begin(lobe, e, smith, facing);
    for (const auto& edge : edges) c = k.ggx_cubature_edge(c, edge, quality == Quality::high ? 2 : 0);
    return k.ggx_cubature_finish(c);
  }
};

// The table is interpolated in S: between its nodes it has derivatives by the view, at them those of one side.
struct TransformedCosine {
  const PreparedPolygon& light;
  int side;
  LtcMethod method;  // classic or compact
  double alpha;

  template <class S, class Direction>
  typename Kernels<S>::vec2 operator()(const Direction& direction, const Vec3<Real<S>>& view) const {
    Kernels<S> k;
    const double rounded_alpha = std::max(alpha, 1e-4);
    const auto at = k.ltc_coordinates(std::sqrt(rounded_alpha), view.z);
    typename Kernels<S>::LtcMatrix m;
    Vec4<S> f;
    if (method == LtcMethod::classic) {
      const ClassicTable& table = ggx_classic_table();
      m = k.ltc_from_classic(look_up<S>(table.matrix, table.size, at));
      f = look_up<S>(table.magnitude, table.size, at);
    } else {
      const CompactTable& table = ggx_compact_table();
      m = k.ltc_from_compact(look_up<S>(table.shapes, table.shape_size, at), rounded_alpha, view);
      f = look_up<S>(table.magnitudes, table.magnitude_size, at);
    }
    auto walk = k.ltc_begin();
    const Vec3d* v = light.vertices.data();
    for (std::size_t c = 0; c + 1 < light.contours.size(); ++c) {
      std::size_t i = light.contours[c + 1] - 1;
      for (std::size_t j = light.contours[c]; j < light.contours[c + 1]; i = j++) {
        const auto a = direction(v[i]), b = direction(v[j]);
        walk = k.ltc_add_edge(walk, m, a, b, k.ltc_direction(m, a), k.ltc_direction(m, b));
      }
    }
    const Real<S> integral = k.ltc_integral(walk, Mask<S>(side < 0));
    return {f.x * integral, f.y * integral};
  }

 private:
  template <class S>
  using Vec4 = typename Kernels<S>::vec4;

  template <class S, std::size_t N>
  static Vec4<S> look_up(const std::vector<std::array<float, N>>& table, int size, const typename Kernels<S>::vec2& at) {
    const Real<S> last(static_cast<double>(size - 1));
    const Real<S> x = at.x * last, y = at.y * last;
    const Real<S> i = min(floor(x), last - Real<S>(1.0)), j = min(floor(y), last - Real<S>(1.0));
    const Real<S> fx = x - i, fy = y - j, one(1.0);
    const auto n = static_cast<std::size_t>(size);
    const std::size_t base = static_cast<std::size_t>(j.v.v) * n + static_cast<std::size_t>(i.v.v);
    const auto mixed = [&](std::size_t c) {
      if (c >= N) return Real<S>(0.0);
      const auto node = [&](std::size_t k) { return Real<S>(static_cast<double>(table[base + k][c])); };
      return (one - fy) * ((one - fx) * node(0) + fx * node(1)) + fy * ((one - fx) * node(n) + fx * node(n + 1));
    };
    return {mixed(0), mixed(1), mixed(2), mixed(3)};
  }
};

}  // namespace steradian
