// Linearly transformed cosines: the cosine's integral over the outline under a matrix (kernels/integral/ltc.glsl).
#pragma once

#include "integrals/integrate.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// A fitted lobe at one view.
template <class S>
struct LtcLobe {
  typename Kernels<S>::LtcMatrix matrix;
  Real<S> n_a{1.0};  // factor of the integral with F = 1 ...
  Real<S> f_a{0.0};  // ... and with F = (1 - v.h)^5
};

template <class S>
SmallLight<S> small_light_under(const LtcLobe<S>& lobe, const typename Kernels<S>::vec3& center) {
  Kernels<S> k;
  return {k.light_elements_diffuse_sharpness() + k.ltc_sharpness(lobe.matrix, center), k.light_elements_transformed()};
}

template <class S>
STERADIAN_INLINE Part<S> value_of(const LtcLobe<S>& lobe, Real<S> integral) {
  return {lobe.n_a * integral, lobe.f_a * integral};
}

// Clips to the horizon by itself: a corner is transformed by the matrix once for its two edges.
template <class S>
class Ltc {
 public:
  static constexpr Clip kClip = Clip::none;
  using K = Kernels<S>;
  using vec3 = typename K::vec3;
  struct End {
    vec3 u, under;
  };

  STERADIAN_INLINE explicit Ltc(const LtcLobe<S>& lobe) : lobe_(lobe) {}
  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    walk_ = K().ltc_begin();
    above_ = shading.view.z > Real<S>(0.0);
    return shading.lit && above_;
  }
  // Anchor of the horizon's arcs, instead of the place at which the outline first crosses it: see kernels/integral/ltc.glsl.
  void anchor(const vec3& u) {
    walk_.anchor = K().ltc_direction(lobe_.matrix, u);
    walk_.anchored = dot(u, u) > Real<S>(0.5);
  }
  STERADIAN_INLINE End end(const vec3& u) const { return {u, K().ltc_direction(lobe_.matrix, u)}; }
  STERADIAN_INLINE void add(const End& a, const End& b) { walk_ = K().ltc_add_edge(walk_, lobe_.matrix, a.u, b.u, a.under, b.under); }
  STERADIAN_INLINE Part<S> finish(Mask<S> reversed) {
    return value_of(lobe_, select(above_, K().ltc_integral(walk_, reversed), Real<S>(0.0)));
  }

  STERADIAN_INLINE Real<S> least_distance2() const { return K().light_elements_transformed().least_distance2; }
  SmallLight<S> small_light(const vec3& center) const { return small_light_under(lobe_, center); }
  Part<S> at(const vec3& u) const { return value_of(lobe_, select(above_, K().ltc_lobe(lobe_.matrix, u), Real<S>(0.0))); }

 protected:
  LtcLobe<S> lobe_;
  typename K::LtcWalk walk_;
  Mask<S> above_;
};

// The irradiance vector under the matrix, for the look-up in a texture (kernels/integral/ltc_texture.glsl).
template <class S>
class LtcVector : public Ltc<S> {
 public:
  using Ltc<S>::Ltc;
  typename Kernels<S>::vec3 finish(Mask<S> reversed) { return Kernels<S>().ltc_texture_irradiance_vector(this->walk_, reversed); }
  typename Kernels<S>::vec3 at(const typename Kernels<S>::vec3& u) const {
    return Kernels<S>().ltc_direction(this->lobe_.matrix, u) * Kernels<S>().ltc_lobe(this->lobe_.matrix, u);
  }
};

// The integral without clipping: a sphere's form factor replaces it.
template <class S>
class CliplessLtc {
 public:
  static constexpr Clip kClip = Clip::none;
  using K = Kernels<S>;
  using vec3 = typename K::vec3;

  explicit CliplessLtc(const LtcLobe<S>& lobe) : lobe_(lobe) {}
  Mask<S> begin(const Shading<S>& shading) {
    sum_ = vec3(0.0, 0.0, 0.0);
    return shading.lit && shading.view.z > Real<S>(0.0);
  }
  vec3 end(const vec3& u) const { return K().ltc_direction(lobe_.matrix, u); }
  void add(const vec3& a, const vec3& b) { sum_ = K().ltc_clipless_add_edge(sum_, a, b); }
  Part<S> finish(Mask<S> reversed) { return value_of(lobe_, K().ltc_clipless_integral(sum_, reversed)); }

  Real<S> least_distance2() const { return K().light_elements_transformed().least_distance2; }
  SmallLight<S> small_light(const vec3& center) const { return small_light_under(lobe_, center); }
  Part<S> at(const vec3& u) const { return value_of(lobe_, K().ltc_lobe(lobe_.matrix, u)); }

 private:
  LtcLobe<S> lobe_;
  vec3 sum_;
};

}  // namespace integrals
STERADIAN_END_ISA
