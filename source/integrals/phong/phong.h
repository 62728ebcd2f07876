// The Phong lobe's integral, by every method that is a sum over edges: the axial moment of the clipped outline.
#pragma once

#include "integrals/integrate.h"
#include "steradian/phong.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// The best form of each fit, over quad, star and triangle and n from 37 to 5001 (docs/theory/moments.md). For the ellipsoid it is f = 1, to
// which it is exact where x^m vanishes; for the two others f = x.
inline bool takes_x(const PhongOptions& options, bool even_n) {
  switch (options.form) {
    case PeakForm::one: return false;
    case PeakForm::x: return true;
    case PeakForm::by_parity: return even_n;
    case PeakForm::best: break;
  }
  return options.method != Method::ellipsoid;
}

// Values that do not depend on light and point.
template <class S>
struct PhongLobe {
  using K = Kernels<S>;

  Real<S> n{1.0};
  int integer_n = 1;     // the series then goes through n + 2
  int f_is_x = 0;        // the peak fits' choice of f
  bool below_1 = false;  // the series then goes through n + 2
  int can_stop = 0;      // arvo's early exit
  Real<S> relative_precision{0.0};
  typename K::MomentSeries series;
  typename K::MomentSeriesHigh series_high;

  STERADIAN_INLINE explicit PhongLobe(double exponent, const PhongOptions& options = {})
      : n(exponent), relative_precision(options.relative_precision) {
    K k;
    integer_n = static_cast<int>(exponent);
    f_is_x = takes_x(options, static_cast<double>(integer_n) == exponent && integer_n % 2 == 0);
    can_stop = options.relative_precision > 0;
    below_1 = exponent < 1;
    const Real<S> order(below_1 ? exponent + 2 : exponent);
    series = k.moment_series_prepare(order);
    series_high = k.moment_series_high_prepare(order);
  }

  // Contribution of one edge to (n + 1) times the moment; r is the lobe's unit axis.
  template <Method method, Quality quality>
  STERADIAN_INLINE Real<S> share(typename K::vec3 a, typename K::vec3 b, typename K::vec3 r) const {
    K k;
    const auto edge = k.moment_edge(a, b, r);
    return k.moment_edge_share(edge, front<method, quality>(edge));
  }

  // |s| times the integral of (1 - x^m)/(1 - x^2) over the part in front of an edge, m = n + 1.
  template <Method method, Quality quality>
  STERADIAN_INLINE Real<S> front(const typename K::MomentEdge& edge) const {
    K k;
    if constexpr (method == Method::exact) {
      return k.moment_quadrature_front(edge, n).moment;
    } else if constexpr (method == Method::arvo) {
      // The sum has no powers: only 1/(1 + x) remains.
      if (integer_n == 0) return k.moment_solid_angle_front(edge);
      return k.moment_arvo_front(edge, integer_n, can_stop, relative_precision);
    } else if constexpr (method == Method::lorentzian) {
      return k.moment_lorentzian_front(edge, n, f_is_x);
    } else if constexpr (method == Method::pearson) {
      return k.moment_pearson_front(edge, n, f_is_x);
    } else if constexpr (method == Method::ellipsoid) {
      return k.moment_ellipsoid_front(edge, n, f_is_x);
    } else if constexpr (quality == Quality::high) {
      return below_1 ? k.moment_series_high_low_front(edge, series_high, n) : k.moment_series_high_front(edge, series_high);
    } else {
      return below_1 ? k.moment_series_low_front(edge, series, n) : k.moment_series_front(edge, series);
    }
  }
};

// Bias of a method over lights that are small against the lobe. Below an exponent of 2 the lobe has a bend at its end, which elements miss:
// they serve only where the lobe is tiny there.
inline double bias_of(double exponent, const PhongOptions& options) {
  Kernels<double> k;
  if (options.method != Method::series || exponent < 2) return 0.0;
  return (options.quality == Quality::high ? k.light_elements_series_high_bias() : k.light_elements_series_bias()).v;
}

// x: radiance of albedo 1, in [0, 1]. share(a, b, axis): one edge's contribution to (n + 1) times the moment, by the options' method.
template <class S, class Share>
class PhongIntegral {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using vec3 = typename Kernels<S>::vec3;

  bool foreshortened = false;  // the shares are those of the lobe times the light's cosine

  STERADIAN_INLINE PhongIntegral(Share share, double exponent, const PhongOptions& options)
      : exponent_(exponent), small_(small_light_of_power<S>(exponent, bias_of(exponent, options))), share_(share) {}
  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    axis_ = Kernels<S>().phong_mirror(shading.view);
    sum_ = 0.0;
    return shading.lit && shading.view.z > Real<S>(0.0);
  }
  STERADIAN_INLINE vec3 end(const vec3& u) const { return u; }
  // Not always inlined: clipping calls it at three places, and in dual numbers one copy is faster.
  void add(const vec3& a, const vec3& b) { sum_ += share_(a, b, axis_); }
  STERADIAN_INLINE Part<S> finish(Mask<S> reversed) { return {Kernels<S>().moment_phong_radiance(sum_, reversed), Real<S>(0.0)}; }

  STERADIAN_INLINE Real<S> least_distance2() const { return small_.limits.least_distance2; }
  SmallLight<S> small_light(const vec3&) const { return small_; }
  Part<S> at(const vec3& u) const {
    const auto in_front = dot(u, axis_) > Real<S>(0.0);
    const Real<S> lobe = Kernels<S>().phong_lobe(u, axis_, Real<S>(exponent_));
    return {select(in_front, foreshortened ? lobe * u.z : lobe, Real<S>(0.0)), Real<S>(0.0)};
  }

 private:
  double exponent_;
  SmallLight<S> small_;
  Share share_;
  vec3 axis_;
  Real<S> sum_{0.0};
};

// Calls use(share) with the function of the method: one type for each, so that a walk contains one method.
template <class S, class Use>
STERADIAN_INLINE auto with_phong_share(const PhongLobe<S>& lobe, const PhongOptions& options, Use use) {
  const auto by = [&]<Method method, Quality quality = Quality::normal>() {
    return use([&lobe](const auto& a, const auto& b, const auto& axis) { return lobe.template share<method, quality>(a, b, axis); });
  };
  switch (options.method) {
    case Method::exact: return by.template operator()<Method::exact>();
    case Method::arvo: return by.template operator()<Method::arvo>();
    case Method::lorentzian: return by.template operator()<Method::lorentzian>();
    case Method::pearson: return by.template operator()<Method::pearson>();
    case Method::ellipsoid: return by.template operator()<Method::ellipsoid>();
    default: break;  // series
  }
  if (options.quality == Quality::high) return by.template operator()<Method::series, Quality::high>();
  return by.template operator()<Method::series>();
}

}  // namespace integrals
STERADIAN_END_ISA
