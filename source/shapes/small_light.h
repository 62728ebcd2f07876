// Small lights: four elements of the light that replace its outline (kernels/outline/light_elements.glsl).
//
// An integral along an outline loses as many digits as the light's size is below its distance. An approximate integral has a bias besides,
// over lights that are small against the lobe. An integral that is a lobe has the members
//
//   SmallLight<S> small_light(const vec3& center) const;    // its requirements on a light in this direction, after begin
//   value at(const vec3& u) const;                          // the lobe in the direction u: like finish, an integral over one steradian
//   Real<S> least_distance2() const;                        // in the light's mean square deviations: nearer lights are not small
//
// and an outline of one light has the members
//
//   elements()                                              // in the shading frame; area as of its front
//   deviation2(), distance2()                               // the light's, for least_distance2
//
// integrate chooses, lane by lane. Where lights are large, none of this costs more than a comparison.
#pragma once

#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// Numbers that decide whether the elements serve.
template <class S>
struct SmallLight {
  Real<S> sharpness;
  typename Kernels<S>::LightElementsLimits limits;
};

// The same for a power n of a cosine, computed in double for every S.
template <class S>
SmallLight<S> small_light_of_power(double n, Real<double> bias) {
  Kernels<double> k;
  const auto limits = k.light_elements_along_power(n, bias);
  return {k.light_elements_power_sharpness(n).v, {limits.roundings.v, limits.least_distance2.v, limits.bias.v}};
}

// Two integrals together need two answers.
template <class A, class B>
struct BothSmall {
  A first;
  B second;
};

template <class S>
STERADIAN_INLINE Mask<S> elements_serve(const typename Kernels<S>::LightElements& e, const SmallLight<S>& light) {
  return Kernels<S>().light_elements_serve(e, {0.0, 0.0, 1.0}, light.sharpness, light.limits.roundings, light.limits.bias);
}
template <class S, class A, class B>
STERADIAN_INLINE auto elements_serve(const typename Kernels<S>::LightElements& e, const BothSmall<A, B>& light) {
  const auto first = elements_serve<S>(e, light.first);
  return BothSmall<Mask<S>, decltype(elements_serve<S>(e, light.second))>{first, elements_serve<S>(e, light.second)};
}

template <class S>
STERADIAN_INLINE Mask<S> in_every_part(Mask<S> m) {
  return m;
}
template <class A, class B>
STERADIAN_INLINE auto in_every_part(const BothSmall<A, B>& m) {
  return in_every_part(m.first) && in_every_part(m.second);
}

}  // namespace integrals
STERADIAN_END_ISA
