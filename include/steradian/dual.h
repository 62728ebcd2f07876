// Dual<N>: a double and its derivatives in N directions. Kernels<Dual<N>> gives every integral with exact derivatives.
//
//   gradient() below seeds the directions and gathers the derivatives of any function of real numbers:
//
//   const Gradient g = gradient({0.3, 2.0}, [](const auto& x) { return x[0] * exp(x[1]); });
//   g.value, g.derivative[0], g.derivative[1]
//
// If a function has a kink (abs, min, max, select, a light's edge in the horizon), the derivative is that of the side taken. The square
// root's derivative at 0 counts as 0: kernels reach it only where the root is multiplied by 0.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA

template <std::size_t N>
struct Dual {
  double v = 0;
  std::array<double, N> d{};

  Dual() = default;
  Dual(double value) : v(value) {}
  // The copy is written out: for the implicit one g++ 12 uses rep movsq, whose start alone costs more than the arithmetic.
  Dual(const Dual& other) { *this = other; }
  Dual& operator=(const Dual& other) {
    v = other.v;
    for (std::size_t i = 0; i < N; ++i) d[i] = other.d[i];
    return *this;
  }

  // f(x), given the value and the slope of f there.
  Dual chain(double value, double slope) const {
    Dual r(value);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = slope * d[i];
    return r;
  }

  friend Dual operator+(Dual a, const Dual& b) {
    a.v += b.v;
    for (std::size_t i = 0; i < N; ++i) a.d[i] += b.d[i];
    return a;
  }
  friend Dual operator-(Dual a, const Dual& b) {
    a.v -= b.v;
    for (std::size_t i = 0; i < N; ++i) a.d[i] -= b.d[i];
    return a;
  }
  friend Dual operator-(const Dual& a) { return a.chain(-a.v, -1.0); }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r(a.v * b.v);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = a.d[i] * b.v + a.v * b.d[i];
    return r;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.v, v = a.v / b.v;
    Dual r(v);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = (a.d[i] - v * b.d[i]) * inverse;
    return r;
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
};

template <std::size_t N>
struct RealTraits<Dual<N>> {
  using D = Dual<N>;
  using Scalar = double;
  using Bool = bool;
  static constexpr int kDigits = 53;

  static D from_double(double x) { return D(x); }
  static D select(bool m, const D& a, const D& b) { return m ? a : b; }
  static bool any(bool m) { return m; }
  static bool all(bool m) { return m; }
  static D abs(const D& x) { return x.v < 0 ? -x : x; }
  static D min(const D& a, const D& b) { return b.v < a.v ? b : a; }
  static D max(const D& a, const D& b) { return a.v < b.v ? b : a; }
  static D floor(const D& x) { return D(std::floor(x.v)); }
  static D sqrt(const D& x) {
    const double root = std::sqrt(x.v);
    return x.chain(root, root > 0 ? 0.5 / root : 0.0);
  }
  static D inversesqrt(const D& x) {
    const double y = 1.0 / std::sqrt(x.v);
    return x.chain(y, -0.5 * y / x.v);
  }
  static D exp(const D& x) {
    const double y = std::exp(x.v);
    return x.chain(y, y);
  }
  static D log(const D& x) { return x.chain(std::log(x.v), 1.0 / x.v); }
};

struct Gradient {
  double value = 0;
  std::vector<double> derivative;  // one for each argument
};

// Value and derivatives of `function` at `x`. The function takes a std::vector of Real<Dual<N>> and returns one, for any N.
// N directions are followed at a time, in ceil(size of x / N) evaluations. An integral that is a sum over edges is cheaper
// edge by edge: see source/integrals/polygon_derivatives.cpp.
template <std::size_t N = 6, class Function>
Gradient gradient(const std::vector<double>& x, Function function) {
  using R = Real<Dual<N>>;
  std::vector<R> arguments(x.begin(), x.end());
  Gradient result;
  for (std::size_t begin = 0; begin < x.size(); begin += N) {
    const std::size_t end = begin + N < x.size() ? begin + N : x.size();
    for (std::size_t i = begin; i < end; ++i) arguments[i].v.d[i - begin] = 1.0;
    const Dual<N> y = function(static_cast<const std::vector<R>&>(arguments)).v;
    for (std::size_t i = begin; i < end; ++i) {
      arguments[i].v.d[i - begin] = 0.0;
      result.derivative.push_back(y.d[i - begin]);
    }
    result.value = y.v;
  }
  return result;
}

STERADIAN_END_ISA
