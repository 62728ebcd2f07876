// Microfacet lobes by arcs in half-vector space: every edge of the clipped outline is split into great-circle arcs.
#pragma once

#include <type_traits>
#include <vector>

#include "integrals/integrate.h"
#include "steradian/half_vector.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// lobe: alpha_x() and alpha_y(); deviation() of the half vectors' slopes in the narrower direction. arc(view, p, q) is the value of an arc
// of unit half vectors in walk order, at_half_vector(view, h) that of a steradian. Further members are finish(view, edges, sum, facing),
// and bias() and at(view, u) for small lights.
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
    edges_.clear();
    return shading.lit && shading.view.z > Real<S>(0.0);
  }
  vec3 end(const vec3& u) const { return u; }
  void add(const vec3& a, const vec3& b) {
    K k;
    const auto edge = k.ggx_edge(view_, a, b);
    if (!any_lane(edge.end > edge.begin)) return;
    edges_.push_back(edge);
    auto walk = k.half_vector_begin(view_, edge);
    for (int j = 1; j <= options_.arcs; ++j) {
      const Real<S> share(static_cast<double>(j) / options_.arcs);
      const auto tau = j == options_.arcs                    ? edge.end
                       : options_.split == ArcSplit::uniform ? k.half_vector_split_uniform(edge, share)
                                                             : k.half_vector_split_pole_mapped(edge, share);
      walk = k.half_vector_next(walk, view_, edge, tau);
      sum_ = sum_ + lobe_.arc(view_, walk.a, walk.b);
      for (int i = 0; i < k.half_vector_nodes(); ++i) {
        const auto node = k.half_vector_node(walk, view_, edge, i);
        sum_ = sum_ + lobe_.at_half_vector(view_, node.h) * node.solid_angle;
      }
    }
  }
  Part<S> finish(Mask<S> reversed) { return lobe_.finish(view_, edges_, sum_, select(reversed, Real<S>(-1.0), Real<S>(1.0))); }

  Real<S> least_distance2() const { return K().light_elements_along_half_vectors(lobe_.bias()).least_distance2; }
  SmallLight<S> small_light(const vec3&) const {
    return {K().light_elements_half_vector_sharpness(lobe_.deviation(), view_.v.z), K().light_elements_along_half_vectors(lobe_.bias())};
  }
  Part<S> at(const vec3& u) const { return lobe_.at(view_, u); }

 private:
  Lobe lobe_;
  HalfVectorOptions options_;
  typename K::GgxView view_;
  std::vector<typename K::ConicArc> edges_;
  decltype(std::declval<Lobe>().nothing()) sum_;
};

// The form of the cosine series that serves an exponent: the range argument of blinn_phong_arc_approximate.
inline int cosine_series_range(double n) { return n < 2 ? 2 : n < 8 ? 1 : 0; }

// Uses quadrature in double, else the cosine series.
template <class S>
class BlinnPhongArcs {
 public:
  using K = Kernels<S>;
  explicit BlinnPhongArcs(double n) : n_(n), range_(cosine_series_range(n)), series_(K().moment_series_prepare(n < 2 ? n + 1 : n - 1)) {}

  Real<S> alpha_x() const { return K().blinn_phong_alpha(n_); }
  Real<S> alpha_y() const { return alpha_x(); }
  Real<S> deviation() const { return inversesqrt(max(n_, Real<S>(1.0e-12))); }
  Real<S> bias() const { return std::is_same_v<S, double> ? Real<S>(0.0) : K().light_elements_series_bias(); }
  template <class View, class V>
  Part<S> at(const View& view, const V& u) const {
    K k;
    const auto d = k.blinn_phong_distribution(k.microfacet_half_vector(u, view.v), n_);
    return {k.microfacet_lobe_unshadowed(d, u, view.v), Real<S>(0.0)};
  }
  Real<S> nothing() const { return 0.0; }
  template <class View, class V>
  Real<S> arc(const View& view, const V& p, const V& q) const {
    if constexpr (std::is_same_v<S, double>)
      return K().blinn_phong_arc(p, q, view.v, n_);
    else
      return K().blinn_phong_arc_approximate(p, q, view.v, series_, n_, range_);
  }
  template <class View, class V>
  Real<S> at_half_vector(const View& view, const V& h) const {
    return K().blinn_phong_at_half_vector(h, view.v, n_);
  }
  template <class View, class Edges>
  Part<S> finish(const View& view, const Edges&, Real<S> sum, Real<S> facing) const {
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
  Real<S> deviation() const { return Real<S>(0.707106781186547524) * min(ax, ay); }
  Real<S> bias() const { return K().light_elements_beckmann_bias(); }
  template <class View, class V>
  Part<S> at(const View& view, const V& u) const {
    K k;
    const auto d = k.beckmann_distribution(k.microfacet_half_vector(u, view.v), ax, ay);
    return {k.microfacet_lobe_unshadowed(d, u, view.v), Real<S>(0.0)};
  }
  Real<S> nothing() const { return 0.0; }
  template <class View, class V>
  Real<S> arc(const View& view, const V& p, const V& q) const {
    return K().beckmann_arc(view, p, q, series);
  }
  template <class View, class V>
  Real<S> at_half_vector(const View& view, const V& h) const {
    return K().beckmann_at_half_vector(view, h);
  }
  template <class View, class Edges>
  Part<S> finish(const View& view, const Edges&, Real<S> sum, Real<S> facing) const {
    return {K().half_vector_radiance(view, sum, facing), Real<S>(0.0)};
  }
};

// The measure of GGX, and the cubature's mean of shadowing and Fresnel.
template <class S>
struct GgxHalfVectorArcs {
  using K = Kernels<S>;
  Real<S> ax, ay, smith;

  Real<S> alpha_x() const { return ax; }
  Real<S> alpha_y() const { return ay; }
  Real<S> deviation() const { return Real<S>(0.5) * min(ax, ay); }
  Real<S> bias() const { return 0.0; }  // chords of short edges are as exact as their arcs
  template <class View, class V>
  Part<S> at(const View& view, const V& u) const {
    return K().ggx_lobe_and_fresnel(view, u, smith);
  }
  typename K::vec3 nothing() const { return {0.0, 0.0, 0.0}; }
  template <class View, class V>
  V arc(const View& view, const V& p, const V& q) const {
    return K().ggx_arc(view, p, q);
  }
  template <class View, class V>
  V at_half_vector(const View& view, const V& h) const {
    return K().ggx_at_half_vector(view, h);
  }
  // Shadowing and Fresnel as in the closed form: only the measure is computed by the arcs.
  template <class View, class Edges, class V>
  Part<S> finish(const View& view, const Edges& edges, const V& e, Real<S> facing) const {
    auto c = K().ggx_cubature_begin(view, e, smith, facing);
    for (const auto& edge : edges) c = K().ggx_cubature_edge(c, edge, 0);
    return K().ggx_cubature_finish(c);
  }
};

}  // namespace integrals
STERADIAN_END_ISA
