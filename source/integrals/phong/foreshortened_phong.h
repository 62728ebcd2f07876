// A Phong lobe times the cosine of the light: the double-axis moment of the lobe's axis and the normal.
//
// (n + 2) times the moment is n (r.z) times the moment of n - 1, a Phong lobe's, and for each edge the z of its plane's normal times the
// integral of x^n along it (kernels/integral/moment_cosine.glsl). The contributions here are scaled like those of Phong, so that its sum
// finishes both: the factor of the lobe stays (n + 1)/(2 pi).
#pragma once

#include "integrals/phong/phong.h"

STERADIAN_BEGIN_ISA
namespace integrals {

template <class S>
class ForeshortenedLobe {
 public:
  using K = Kernels<S>;

  // exponent: 0 or more.
  ForeshortenedLobe(double exponent, double precision)
      : n_(exponent),
        factor_((exponent + 1) / (exponent + 2)),
        level_(exponent == 0),
        low_(exponent < 8 ? 1 : 0),
        lower_(exponent - 1, PhongOptions{.relative_precision = precision}) {}

  // Contribution of one edge; r is the lobe's unit axis, z the normal.
  template <Method method, Quality quality>
  Real<S> share(typename K::vec3 a, typename K::vec3 b, typename K::vec3 r) const {
    K k;
    const auto edge = k.moment_edge(a, b, r);
    Real<S> front(0.0), cosines(0.0);
    if constexpr (method == Method::exact || method == Method::arvo) {
      const auto q = k.moment_foreshortened_front(edge, n_, level_);
      front = method == Method::exact || level_ ? q.moment : lower_.template front<method, quality>(edge);
      cosines = q.power;
    } else {
      front = lower_.template front<method, quality>(edge);
      cosines = k.moment_cosine_front(edge, n_, low_);
    }
    return factor_ * k.moment_foreshortened_share(edge, a, b, r, front, cosines);
  }

 private:
  Real<S> n_, factor_;
  bool level_;
  int low_;
  PhongLobe<S> lower_;  // of exponent n - 1
};

// Like with_phong_share, for the methods that support it: exact, arvo, series.
template <class S, class Use>
auto with_foreshortened_share(const ForeshortenedLobe<S>& lobe, const PhongOptions& options, Use use) {
  const auto by = [&]<Method method, Quality quality = Quality::normal>() {
    return use([&lobe](const auto& a, const auto& b, const auto& axis) { return lobe.template share<method, quality>(a, b, axis); });
  };
  if (options.method == Method::exact) return by.template operator()<Method::exact>();
  if (options.method == Method::arvo) return by.template operator()<Method::arvo>();
  if (options.quality == Quality::high) return by.template operator()<Method::series, Quality::high>();
  return by.template operator()<Method::series>();
}

}  // namespace integrals
STERADIAN_END_ISA
