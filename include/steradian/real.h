// Real<S> and Mask<S>: the numbers of the kernel dialect in C++.
//
// S is what one number is made of: double, float, a SIMD pack of floats, a dual number. Real<S> gives it the
// arithmetic and the handful of functions that kernels may use (docs/dialect.md), and takes the plain decimal
// literals of kernels (0.5) whatever S is. A new kind of number is added by specialising RealTraits<S>.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "steradian/config.h"

STERADIAN_BEGIN_ISA

// Properties of S that Real<S> needs. This general form serves the scalar types.
template <class S>
struct RealTraits {
  using Scalar = S;  // one lane
  using Bool = bool;
  static constexpr int kDigits = std::numeric_limits<S>::digits;  // 24: float forms of polynomials, 53: double

  static S from_double(double x) { return static_cast<S>(x); }
  static S select(bool m, S a, S b) { return m ? a : b; }
  static bool any(bool m) { return m; }
  static bool all(bool m) { return m; }
  static S abs(S x) { return std::abs(x); }
  static S min(S a, S b) { return b < a ? b : a; }
  static S max(S a, S b) { return a < b ? b : a; }
  static S floor(S x) { return std::floor(x); }
  static S sqrt(S x) { return std::sqrt(x); }
  static S inversesqrt(S x) { return S(1) / std::sqrt(x); }
  static S exp(S x) { return std::exp(x); }
  static S log(S x) { return std::log(x); }
};

template <class S>
struct Mask {
  using Bool = typename RealTraits<S>::Bool;
  Bool m;

  Mask() = default;
  STERADIAN_INLINE explicit Mask(Bool b) : m(b) {}

  STERADIAN_INLINE friend Mask operator&&(Mask a, Mask b) { return Mask(Bool(a.m & b.m)); }
  STERADIAN_INLINE friend Mask operator||(Mask a, Mask b) { return Mask(Bool(a.m | b.m)); }
  STERADIAN_INLINE friend Mask operator!(Mask a) { return Mask(Bool(!a.m)); }
};

template <class S>
struct Real {
  using T = RealTraits<S>;
  using M = Mask<S>;
  S v;

  Real() = default;
  STERADIAN_INLINE Real(double x) : v(T::from_double(x)) {}  // implicit: the literals of kernels
  STERADIAN_INLINE static Real of(S x) {
    Real r;
    r.v = x;
    return r;
  }

  STERADIAN_INLINE friend Real operator+(Real a, Real b) { return of(a.v + b.v); }
  STERADIAN_INLINE friend Real operator-(Real a, Real b) { return of(a.v - b.v); }
  STERADIAN_INLINE friend Real operator*(Real a, Real b) { return of(a.v * b.v); }
  STERADIAN_INLINE friend Real operator/(Real a, Real b) { return of(a.v / b.v); }
  STERADIAN_INLINE friend Real operator-(Real a) { return of(-a.v); }
  STERADIAN_INLINE Real& operator+=(Real b) { return *this = *this + b; }
  STERADIAN_INLINE Real& operator-=(Real b) { return *this = *this - b; }
  STERADIAN_INLINE Real& operator*=(Real b) { return *this = *this * b; }
  STERADIAN_INLINE Real& operator/=(Real b) { return *this = *this / b; }

  STERADIAN_INLINE friend M operator<(Real a, Real b) { return M(a.v < b.v); }
  STERADIAN_INLINE friend M operator>(Real a, Real b) { return M(b.v < a.v); }
  STERADIAN_INLINE friend M operator<=(Real a, Real b) { return M(a.v <= b.v); }
  STERADIAN_INLINE friend M operator>=(Real a, Real b) { return M(b.v <= a.v); }

  STERADIAN_INLINE friend Real select(M m, Real a, Real b) { return of(T::select(m.m, a.v, b.v)); }
  STERADIAN_INLINE friend Real abs(Real x) { return of(T::abs(x.v)); }
  STERADIAN_INLINE friend Real min(Real a, Real b) { return of(T::min(a.v, b.v)); }
  STERADIAN_INLINE friend Real max(Real a, Real b) { return of(T::max(a.v, b.v)); }
  STERADIAN_INLINE friend Real clamp(Real x, Real low, Real high) { return min(max(x, low), high); }
  STERADIAN_INLINE friend Real floor(Real x) { return of(T::floor(x.v)); }
  STERADIAN_INLINE friend Real sqrt(Real x) { return of(T::sqrt(x.v)); }
  STERADIAN_INLINE friend Real inversesqrt(Real x) { return of(T::inversesqrt(x.v)); }
  STERADIAN_INLINE friend Real exp(Real x) { return of(T::exp(x.v)); }
  STERADIAN_INLINE friend Real log(Real x) { return of(T::log(x.v)); }
};

// Selects between two literals.
template <class S>
STERADIAN_INLINE Real<S> select(Mask<S> m, double a, double b) {
  return select(m, Real<S>(a), Real<S>(b));
}
template <class S>
STERADIAN_INLINE bool any_lane(Mask<S> m) {
  return RealTraits<S>::any(m.m);
}
template <class S>
STERADIAN_INLINE bool all_lanes(Mask<S> m) {
  return RealTraits<S>::all(m.m);
}

STERADIAN_END_ISA
