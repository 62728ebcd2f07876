// Charlie's sheen: a cubature over the light's outline, fanned about its mean direction (kernels/integral/charlie_cubature.glsl).
#pragma once

#include <vector>

#include "integrals/integrate.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// It takes two walks: the first stores the clipped outline and the sum that gives the light's direction. One object serves a thread for all
// its lights. x: radiance of colour 1.
template <class S>
class CharlieIntegral {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using K = Kernels<S>;
  using vec3 = typename K::vec3;

  Real<S> alpha{1.0};

  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    lit_ = shading.lit && shading.view.z > Real<S>(0.0);
    lobe_ = K().charlie_prepare(shading.view, alpha);
    edges_.clear();
    sum_ = vec3(0.0, 0.0, 0.0);
    return lit_;
  }
  // Lanes without light walk edges of no length, so that the others never wait for them.
  STERADIAN_INLINE vec3 end(const vec3& u) const { return select(lit_, u, vec3(0.0, 0.0, 0.0)); }
  STERADIAN_INLINE void add(const vec3& a, const vec3& b) {
    edges_.push_back({a, b});
    sum_ = sum_ + K().polygon_edge(a, b);
  }
  Part<S> finish(Mask<S> reversed) {
    auto c = K().charlie_cubature_begin(lobe_, sum_, select(reversed, Real<S>(-1.0), Real<S>(1.0)));
    for (const Edge& edge : edges_) c = K().charlie_cubature_edge(c, edge.a, edge.b);
    return {K().charlie_cubature_finish(c), Real<S>(0.0)};
  }

  // There are fewer roundings than along arcs: the lobe may have a bend about its dark middle.
  STERADIAN_INLINE Real<S> least_distance2() const { return K().light_elements_transformed().least_distance2; }
  SmallLight<S> small_light(const vec3&) const {
    const Real<S> deviation = sqrt(alpha);  // deviation of a power 1 / alpha of a sine
    return {K().light_elements_half_vector_sharpness(deviation, lobe_.view.z), K().light_elements_transformed()};
  }
  Part<S> at(const vec3& u) const { return {K().charlie_lobe(lobe_, u), Real<S>(0.0)}; }

 private:
  struct Edge {
    vec3 a, b;
  };
  typename K::CharlieLobe lobe_;
  Mask<S> lit_;
  std::vector<Edge> edges_;
  vec3 sum_{0.0, 0.0, 0.0};
};

}  // namespace integrals
STERADIAN_END_ISA
