// A Phong lobe prepared for a number type: what does not depend on the light.
#pragma once

#include <cmath>

#include "steradian/kernels.h"
#include "steradian/phong.h"

STERADIAN_BEGIN_ISA

template <class S>
struct PhongLobe {
  using K = Kernels<S>;

  Real<S> n{1.0};
  int integer_n = 1;    // arvo's count of steps
  int even_n = 0;       // of an integer exponent: the peak fits' choice of f
  bool below_1 = false; // the series then goes through n + 2
  int can_stop = 0;     // arvo's early exit
  Real<S> relative_precision{0.0};
  typename K::MomentSeries series;
  typename K::MomentSeriesHigh series_high;

  STERADIAN_INLINE PhongLobe(double exponent, double precision) : n(exponent), relative_precision(precision) {
    K k;
    integer_n = static_cast<int>(exponent);
    even_n = static_cast<double>(integer_n) == exponent && integer_n % 2 == 0;
    can_stop = precision > 0;
    below_1 = exponent < 1;
    const Real<S> order(below_1 ? exponent + 2 : exponent);
    series = k.moment_series_prepare(order);
    series_high = k.moment_series_high_prepare(order);
  }

  // One edge's share of (n + 1) times the moment; r the lobe's unit axis.
  template <PhongMethod method, PhongQuality quality>
  STERADIAN_INLINE Real<S> share(typename K::vec3 a, typename K::vec3 b, typename K::vec3 r) const {
    K k;
    const auto edge = k.moment_edge(a, b, r);
    return k.moment_edge_share(edge, front<method, quality>(edge));
  }

 private:
  template <PhongMethod method, PhongQuality quality>
  STERADIAN_INLINE Real<S> front(const typename K::MomentEdge& edge) const {
    K k;
    if constexpr (method == PhongMethod::exact) {
      return k.moment_quadrature_front(edge, n).moment;
    } else if constexpr (method == PhongMethod::arvo) {
      // The sum of no power at all: 1/(1 + x) is what is left.
      if (integer_n == 0) return k.moment_solid_angle_front(edge);
      return k.moment_arvo_front(edge, integer_n, can_stop, relative_precision);
    } else if constexpr (method == PhongMethod::lorentzian) {
      return k.moment_lorentzian_front(edge, n, even_n);
    } else if constexpr (method == PhongMethod::pearson) {
      return k.moment_pearson_front(edge, n, even_n);
    } else if constexpr (method == PhongMethod::ellipsoid) {
      return k.moment_ellipsoid_front(edge, n, even_n);
    } else if constexpr (quality == PhongQuality::high) {
      return below_1 ? k.moment_series_high_low_front(edge, series_high, n)
                     : k.moment_series_high_front(edge, series_high);
    } else {
      return below_1 ? k.moment_series_low_front(edge, series, n) : k.moment_series_front(edge, series);
    }
  }
};

STERADIAN_END_ISA
