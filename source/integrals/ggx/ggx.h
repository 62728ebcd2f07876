// GGX in closed form: the exact integral of its distribution, times a cubature's average of shadowing and Fresnel.
#pragma once

#include <vector>

#include "integrals/integrate.h"
#include "steradian/closed_form.h"  // Quality

STERADIAN_BEGIN_ISA
namespace integrals {

// The clipped outline, stored as arcs in stretched half-vector space. One object serves a thread for all its lights.
template <class S>
class GgxArcs {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using K = Kernels<S>;
  using vec3 = typename K::vec3;

  Real<S> alpha_x{1.0}, alpha_y{1.0};  // the lobe's widths, x along the shading frame's

  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    lit_ = shading.lit && shading.view.z > Real<S>(0.0);
    view_ = K().ggx_view(shading.view, alpha_x, alpha_y);
    edges_.clear();
    return lit_;
  }
  // Lanes without light walk edges of no length, so that the others never wait for them.
  STERADIAN_INLINE vec3 end(const vec3& u) const { return select(lit_, u, vec3(0.0, 0.0, 0.0)); }
  STERADIAN_INLINE void add(const vec3& a, const vec3& b) { edges_.push_back({a, b, true}); }
  STERADIAN_INLINE void close(const vec3& a, const vec3& b) { edges_.push_back({a, b, false}); }

  STERADIAN_INLINE const typename K::GgxView& view() const { return view_; }
  // After finish: use(arc) for the part above the horizon of each of the outline's edges, in walk order.
  template <class Use>
  STERADIAN_INLINE void each_edge(Use use) const {
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (edges_[i].is_of_outline) use(arcs_[i]);
  }

  STERADIAN_INLINE Real<S> least_distance2() const { return K().light_elements_along_arcs().least_distance2; }
  SmallLight<S> small_light(const vec3&) const {
    const Real<S> deviation = Real<S>(0.5) * min(alpha_x, alpha_y);
    return {K().light_elements_half_vector_sharpness(deviation, view_.v.z), K().light_elements_along_arcs()};
  }

 protected:
  // Turns the edges into arcs; returns the sum of their vectors.
  STERADIAN_INLINE vec3 prepare() {
    vec3 e(0.0, 0.0, 0.0);
    arcs_.clear();
    for (const Edge& edge : edges_) {
      arcs_.push_back(K().ggx_edge(view_, edge.a, edge.b));
      if (is_seen(arcs_.back())) e = e + K().conic_vector(arcs_.back());
    }
    return e;
  }
  STERADIAN_INLINE static Real<S> facing(Mask<S> reversed) { return select(reversed, Real<S>(-1.0), Real<S>(1.0)); }

  STERADIAN_INLINE static bool is_seen(const typename K::ConicArc& arc) { return any_lane(arc.end > arc.begin); }

  struct Edge {
    vec3 a, b;
    bool is_of_outline;
  };
  typename K::GgxView view_{};
  Mask<S> lit_{};
  std::vector<Edge> edges_;
  std::vector<typename K::ConicArc> arcs_;  // of the edges
};

template <class S>
class GgxIntegral : public GgxArcs<S> {
 public:
  using K = Kernels<S>;
  Real<S> smith{1.0};  // 1 with shadowing, 0 without
  Quality quality = Quality::normal;

  STERADIAN_INLINE Part<S> finish(Mask<S> reversed) {
    const auto e = this->prepare();
    const Real<S> facing = this->facing(reversed);
    if (quality == Quality::draft) return K().ggx_draft(this->view_, e, smith, facing);
    auto c = K().ggx_cubature_begin(this->view_, e, smith, facing);
    const int extra_nodes = quality == Quality::high ? 2 : 0;
    for (const auto& arc : this->arcs_)
      if (this->is_seen(arc)) c = K().ggx_cubature_edge(c, arc, extra_nodes);
    return K().ggx_cubature_finish(c);
  }
  Part<S> at(const typename K::vec3& u) const { return K().ggx_lobe_and_fresnel(this->view_, u, smith); }
};

// GGX without shadowing and with F = 1, exact: x.
template <class S>
class UnshadowedGgx : public GgxArcs<S> {
 public:
  STERADIAN_INLINE Part<S> finish(Mask<S> reversed) {
    const auto e = this->prepare();
    return {Kernels<S>().ggx_unshadowed(this->view_, e * this->facing(reversed)), Real<S>(0.0)};
  }
  Part<S> at(const typename Kernels<S>::vec3& u) const { return {Kernels<S>().ggx_lobe_and_fresnel(this->view_, u, 0.0).x, Real<S>(0.0)}; }
};

}  // namespace integrals
STERADIAN_END_ISA
