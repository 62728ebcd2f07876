// Small lights: four elements of the light in the place of its outline (kernels/outline/light_elements.glsl).
//
// An integral along an outline loses the digits that the light's size is short of its distance; one that approximates has a bias
// besides, over lights that are small against the lobe. An integral that is a lobe says so by
//
//   SmallLight<S> small_light(const vec3& center) const;    // what it asks of a light in this direction, after begin
//   value at(const vec3& u) const;                          // the lobe in the direction u: like finish, an integral over one steradian
//   double least_distance2() const;                         // in the light's mean square deviations: nearer lights are not small
//
// and an outline that is one light's by
//
//   elements()                                              // in the shading frame; area as of its front
//   deviation2(), distance2()                               // the light's, for least_distance2
//
// integrate chooses, lane by lane. Nothing of this costs more than a comparison where lights are large.
#pragma once

#include <algorithm>
#include <cmath>

#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// Roundings that an integral makes, as light_elements_serve counts them: two for Lambert's edges, which add up vectors of the
// light's size; the others subtract numbers of the order of 1 where the edge is short, a hundred times the error at the sizes in
// question. The distances are where t^3 / 8 of the least sharpness comes down to that of float; double asks for more.
struct SmallLightLimits {
  double roundings;
  double least_distance2;
};
inline constexpr SmallLightLimits kAlongEdges{2, 4000}, kTransformed{8, 2000}, kAlongArcs{128, 500};
// Integrals along arcs of half vectors have a bias that makes the elements better from far nearer on.
inline constexpr double kHalfVectorsLeastDistance2 = 30;

// Bias of Phong's series, which are off by so much of the full lobe for each half of an edge (kernels/integral/moment_series.glsl): over a
// light that is small against the lobe, by a share of the light. The numbers are t^3 / 8 where the elements' error is as large.
inline constexpr double kUnbiased = 0, kSeriesBias = 1.0 / 64, kHighSeriesBias = 1.0 / 115, kBeckmannBias = 1.0 / 200;

// Of a power n of a cosine: sharpness as light_elements_sharpness has it, of the deviation 1 / sqrt(n), and where t^3 / 8 comes
// below the bias, or below what the roundings are.
inline double sharpness_of_power(double n) { return 2.5 + std::sqrt(n); }
inline double least_distance2_of_power(double n, bool biased) {
  const double sharpness = sharpness_of_power(n);
  return biased ? std::min(kAlongArcs.least_distance2, 4 * sharpness * sharpness) : kAlongArcs.least_distance2;
}

// What decides whether the elements serve.
template <class S>
struct SmallLight {
  Real<S> sharpness;
  double roundings;
  double bias = kUnbiased;
};

// Two integrals together ask for two answers.
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
