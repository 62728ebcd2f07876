#include "steradian/half_vector.h"

#include <string>
#include <type_traits>

#include "ggx/clipped_walk.h"
#include "steradian/albedo.h"
#include "steradian/error.h"

namespace steradian {
namespace {

// Calls add(p, q) for the arcs of all edges, p and q unit half vectors in walk order.
template <class S, class Add>
void walk_arcs(const PreparedPolygon& light, const ShadingPoint& at, const Frame& frame,
               const typename Kernels<S>::GgxView& view, const HalfVectorOptions& options, Add add) {
  Kernels<S> k;
  walk_clipped_edges<S>(light, frame, at.position, [&](const auto& a, const auto& b) {
    const auto edge = k.ggx_edge(view, a, b);
    if (!any_lane(edge.end > edge.begin)) return;
    auto p = k.half_vector_at(view, edge, edge.begin);
    for (int j = 1; j <= options.arcs; ++j) {
      const Real<S> share(static_cast<double>(j) / options.arcs);
      const auto tau = j == options.arcs                      ? edge.end
                       : options.split == ArcSplit::uniform ? k.half_vector_split_uniform(edge, share)
                                                              : k.half_vector_split_pole_mapped(edge, share);
      const auto q = k.half_vector_at(view, edge, tau);
      add(p, q);
      p = q;
    }
  });
}

template <class S>
class BlinnPhong {
 public:
  explicit BlinnPhong(double n) : n_(n), range_(n < 2 ? 2 : n < 8 ? 1 : 0) {
    series_ = Kernels<S>().moment_series_prepare(n < 2 ? n + 1 : n - 1);
  }
  template <class V>
  Real<S> arc(const V& p, const V& q, const V& v) const {
    Kernels<S> k;
    if constexpr (std::is_same_v<S, double>)
      return k.blinn_phong_arc(p, q, v, n_);
    else
      return k.blinn_phong_arc_approximate(p, q, v, series_, n_, range_);
  }

 private:
  Real<S> n_;
  int range_;
  typename Kernels<S>::MomentSeries series_;
};

template <class S>
Vec3d radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& m, const HalfVectorOptions& options) {
  using Number = Real<S>;
  Kernels<S> k;
  if (options.arcs < 1) throw Error("arcs", "must be 1 or more, here is " + std::to_string(options.arcs));
  if (m.brdf != Brdf::ggx && m.brdf != Brdf::blinn_phong && m.brdf != Brdf::beckmann)
    throw Error("material.brdf", std::string("half vectors have no ") + name_of(m.brdf), "use blinn-phong, beckmann or ggx");
  const int side = light.side_of(at.position);
  const bool lit = side > 0 || (side < 0 && light.two_sided);
  if (!lit || !(dot(at.view, at.normal) > 0)) return {};

  const bool blinn = m.brdf == Brdf::blinn_phong;
  const Frame frame = Frame::from_normal_and_tangent(at.normal, blinn ? Vec3d{} : m.tangent);
  const Number ax = blinn ? k.blinn_phong_alpha(m.exponent) : Number(m.alpha_x);
  const Number ay = blinn ? k.blinn_phong_alpha(m.exponent) : Number(m.alpha_y);
  const auto view = k.ggx_view(to_kernel<S>(frame.to_local(at.view)), ax, ay);
  const Number facing(side);
  Number sum(0.0);

  if (m.brdf == Brdf::ggx) {
    typename Kernels<S>::vec3 e(0.0, 0.0, 0.0);
    walk_arcs<S>(light, at, frame, view, options, [&](const auto& p, const auto& q) { e = e + k.ggx_arc(view, p, q); });
    const auto r = k.ggx_draft(view, e, m.shadowing ? 1.0 : 0.0, facing);
    const auto channel = [&](double f0, double f90) { return static_cast<double>(k.ggx_radiance(r, f0, f90).v); };
    return light.radiance * Vec3d{channel(m.f0.x, m.f90.x), channel(m.f0.y, m.f90.y), channel(m.f0.z, m.f90.z)};
  }
  if (blinn) {
    const BlinnPhong<S> lobe(m.exponent);
    walk_arcs<S>(light, at, frame, view, options, [&](const auto& p, const auto& q) { sum += lobe.arc(p, q, view.v); });
  } else {
    const auto series = k.beckmann_series();
    walk_arcs<S>(light, at, frame, view, options,
                 [&](const auto& p, const auto& q) { sum += k.beckmann_arc(view, p, q, series); });
  }
  return light.radiance * static_cast<double>(k.half_vector_radiance(view, sum, facing).v);
}

}  // namespace

Vec3d half_vector_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                           const HalfVectorOptions& options) {
  return radiance<double>(light, at, with_multiple_scattering(material, at), options);
}
Vec3d half_vector_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                 const HalfVectorOptions& options) {
  return radiance<float>(light, at, with_multiple_scattering(material, at), options);
}

}  // namespace steradian
