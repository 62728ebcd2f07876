// Small lights: four elements of the light that replace its outline (kernels/outline/light_elements.glsl).
//
// An integral along an outline loses as many digits as the light's size is below its distance. An approximate integral has a bias besides,
// over lights that are small against the lobe. An integral that is a lobe has the members
//
//   SmallLight<S> small_light(const vec3& center) const;    // its requirements on a light in this direction, after begin
//   value at(const vec3& u) const;                          // the lobe in the direction u: like finish, an integral over one steradian
//   double least_distance2() const;                         // in the light's mean square deviations: nearer lights are not small
//
// and an outline of one light has the members
//
//   elements()                                              // in the shading frame; area as of its front
//   deviation2(), distance2()                               // the light's, for least_distance2
//
// integrate chooses, lane by lane. Where lights are large, none of this costs more than a comparison.
#pragma once

#include <algorithm>
#include <cmath>

#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// Rounding errors of an integral, as light_elements_serve counts them. Lambert's edges have two, since they add up vectors of the light's
// size. The others subtract numbers of the order of 1 where the edge is short: a hundred times the error at the sizes in question. At these
// distances t^3 / 8 of the least sharpness falls to the rounding of float; double would need larger ones.
struct SmallLightLimits {
  double roundings;
  double least_distance2;
};
inline constexpr SmallLightLimits kAlongEdges{2, 4000}, kTransformed{8, 2000}, kAlongArcs{128, 500};
// Integrals along arcs of half vectors have a bias that makes the elements better from much nearer on.
inline constexpr double kHalfVectorsLeastDistance2 = 30;

// Bias of Phong's series. Their error is that fraction of the full lobe for each half of an edge (kernels/integral/moment_series.glsl).
// Over a light that is small against the lobe, it is that fraction of the light. The numbers are t^3 / 8 where the elements' error is as
// large.
inline constexpr double kUnbiased = 0, kSeriesBias = 1.0 / 64, kHighSeriesBias = 1.0 / 115, kBeckmannBias = 1.0 / 200;

// Sharpness of a power n of a cosine, as light_elements_sharpness defines it, with the deviation 1 / sqrt(n). The distance is where t^3 / 8
// falls below the bias, or below the rounding.
inline double sharpness_of_power(double n) { return 2.5 + std::sqrt(n); }
inline double least_distance2_of_power(double n, bool biased) {
  const double sharpness = sharpness_of_power(n);
  return biased ? std::min(kAlongArcs.least_distance2, 4 * sharpness * sharpness) : kAlongArcs.least_distance2;
}

// Numbers that decide whether the elements serve.
template <class S>
struct SmallLight {
  Real<S> sharpness;
  double roundings;
  double bias = kUnbiased;
};

// Two integrals together need two answers.
template <class A, class B>
struct BothSmall {
  A first;
  B second;
};

template <class S>
STERADIAN_INLINE Mask<S> elements_serve(const typename Kernels<S>::LightElements& e, const SmallLight<S>& light) {
  return Kernels<S>().light_elements_serve(e, {0.0, 0.0, 1.0}, light.sharpness, Real<S>(light.roundings), Real<S>(light.bias));
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
