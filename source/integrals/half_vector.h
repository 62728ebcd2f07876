// Microfacet lobes by arcs in half-vector space: every edge of the clipped outline is split into great-circle arcs.
#pragma once

#include <type_traits>

#include "integrals/integrate.h"
#include "steradian/half_vector.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// lobe: alpha_x() and alpha_y(); arc(view, p, q) of an arc of unit half vectors in walk order; finish(view, sum, facing).
template <class S, class Lobe>
class HalfVector {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using K = Kernels<S>;
  using vec3 = typename K::vec3;

  HalfVector(const Lobe& lobe, const HalfVectorOptions& options) : lobe_(lobe), options_(options) {}
  Mask<S> begin(const Shading<S>& shading) {
    view_ = K().ggx_view(shading.view, lobe_.alpha_x(), lobe_.alpha_y());
    sum_ = lobe_.nothing();
    return shading.lit && shading.view.z > Real<S>(0.0);
  }
  vec3 end(const vec3& u) const { return u; }
  void add(const vec3& a, const vec3& b) {
    K k;
    const auto edge = k.ggx_edge(view_, a, b);
    if (!any_lane(edge.end > edge.begin)) return;
    auto p = k.half_vector_at(view_, edge, edge.begin);
    for (int j = 1; j <= options_.arcs; ++j) {
      const Real<S> share(static_cast<double>(j) / options_.arcs);
      const auto tau = j == options_.arcs                     ? edge.end
                       : options_.split == ArcSplit::uniform ? k.half_vector_split_uniform(edge, share)
                                                             : k.half_vector_split_pole_mapped(edge, share);
      const auto q = k.half_vector_at(view_, edge, tau);
      sum_ = sum_ + lobe_.arc(view_, p, q);
      p = q;
    }
  }
  Part<S> finish(Mask<S> reversed) { return lobe_.finish(view_, sum_, select(reversed, Real<S>(-1.0), Real<S>(1.0))); }

 private:
  Lobe lobe_;
  HalfVectorOptions options_;
  typename K::GgxView view_;
  decltype(std::declval<Lobe>().nothing()) sum_;
};

// In double by quadrature, else by the cosine series.
template <class S>
class BlinnPhongArcs {
 public:
  using K = Kernels<S>;
  explicit BlinnPhongArcs(double n) : n_(n), range_(n < 2 ? 2 : n < 8 ? 1 : 0), series_(K().moment_series_prepare(n < 2 ? n + 1 : n - 1)) {}

  Real<S> alpha_x() const { return K().blinn_phong_alpha(n_); }
  Real<S> alpha_y() const { return alpha_x(); }
  Real<S> nothing() const { return 0.0; }
  template <class View, class V>
  Real<S> arc(const View& view, const V& p, const V& q) const {
    if constexpr (std::is_same_v<S, double>)
      return K().blinn_phong_arc(p, q, view.v, n_);
    else
      return K().blinn_phong_arc_approximate(p, q, view.v, series_, n_, range_);
  }
  template <class View>
  Part<S> finish(const View& view, Real<S> sum, Real<S> facing) const {
    return {K().half_vector_radiance(view, sum, facing), Real<S>(0.0)};
  }

 private:
  Real<S> n_;
  int range_;
  typename K::MomentSeries series_;
};

template <class S>
struct BeckmannArcs {
  using K = Kernels<S>;
  Real<S> ax, ay;
  decltype(K().beckmann_series()) series = K().beckmann_series();

  Real<S> alpha_x() const { return ax; }
  Real<S> alpha_y() const { return ay; }
  Real<S> nothing() const { return 0.0; }
  template <class View, class V>
  Real<S> arc(const View& view, const V& p, const V& q) const {
    return K().beckmann_arc(view, p, q, series);
  }
  template <class View>
  Part<S> finish(const View& view, Real<S> sum, Real<S> facing) const {
    return {K().half_vector_radiance(view, sum, facing), Real<S>(0.0)};
  }
};

// Shadowing and Fresnel at one direction.
template <class S>
struct GgxHalfVectorArcs {
  using K = Kernels<S>;
  Real<S> ax, ay, smith;

  Real<S> alpha_x() const { return ax; }
  Real<S> alpha_y() const { return ay; }
  typename K::vec3 nothing() const { return {0.0, 0.0, 0.0}; }
  template <class View, class V>
  V arc(const View& view, const V& p, const V& q) const {
    return K().ggx_arc(view, p, q);
  }
  template <class View, class V>
  Part<S> finish(const View& view, const V& e, Real<S> facing) const {
    return K().ggx_draft(view, e, smith, facing);
  }
};

}  // namespace integrals
STERADIAN_END_ISA
