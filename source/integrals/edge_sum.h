// The sum of any function of an edge over an outline clipped to the horizon.
#pragma once

#include "integrals/integrate.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// share(a, b): contribution of an edge that is not below the horizon, a Real<S>. x: the sum, in walk order.
template <class S, class Share>
class EdgeSum {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using vec3 = typename Kernels<S>::vec3;

  STERADIAN_INLINE explicit EdgeSum(Share share) : share_(share) {}
  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    sum_ = 0.0;
    return shading.lit;
  }
  STERADIAN_INLINE vec3 end(const vec3& u) const { return u; }
  STERADIAN_INLINE void add(const vec3& a, const vec3& b) { sum_ += share_(a, b); }
  STERADIAN_INLINE Part<S> finish(Mask<S>) { return {sum_, Real<S>(0.0)}; }

 private:
  Share share_;
  Real<S> sum_{0.0};
};

template <class S, class Outline, class Share>
Real<S> sum_over_edges(const Outline& outline, Share share) {
  EdgeSum<S, Share> integral(share);
  return integrate(outline, shading_from<S>(1, {0.0, 0.0, 1.0}), integral).x;
}

}  // namespace integrals
STERADIAN_END_ISA
