// Rounded<Model>: a number with a bound on its error in float arithmetic.
//
// A kernel instantiated with it returns, for one input, the value of its algorithm without roundings (in double). It also returns a bound
// on the distance of any evaluation in float. This is running error analysis: each operation adds its own rounding and passes on those of
// its operands. Contraction to fused multiply-add only removes roundings, so the bound holds for it too. If a comparison is closer than the
// errors of its sides, either branch may have been taken, and the bound covers both. Source: Higham, "Accuracy and stability of numerical
// algorithms", 2002, section 3.3.
#pragma once

#include <cmath>
#include <limits>

#include "steradian/real.h"

STERADIAN_BEGIN_ISA

// Roundings in units of half an ulp of 24 bits, 2^-24 of the result.
struct CpuModel {
  static constexpr double kDivision = 1, kRoot = 1;
  static constexpr double kInverseRoot = 6;               // the packs' Newton step: 3 ulp (source/core/pack.h)
  static constexpr double kExp = 4, kExpPerArgument = 0;  // 2 ulp: xsimd documents 1.5, C libraries 1
  static constexpr double kLog = 4, kLogAbsolute = 0;
};

// Vulkan's guarantees for any device (specification, "Precision and Operation of SPIR-V Instructions").
struct GpuModel {
  static constexpr double kDivision = 5;                  // 2.5 ulp
  static constexpr double kRoot = 9;                      // as 1 / inversesqrt
  static constexpr double kInverseRoot = 4;               // 2 ulp
  static constexpr double kExp = 6, kExpPerArgument = 4;  // 3 + 2 |x| ulp
  static constexpr double kLog = 6, kLogAbsolute = 0x1p-21;
};

struct UncertainBool {
  bool value, uncertain;
  friend UncertainBool operator&(UncertainBool a, UncertainBool b) {
    const bool certainly_false = (!a.value && !a.uncertain) || (!b.value && !b.uncertain);
    return {a.value && b.value, !certainly_false && (a.uncertain || b.uncertain)};
  }
  friend UncertainBool operator|(UncertainBool a, UncertainBool b) { return !((!a) & (!b)); }
  friend UncertainBool operator!(UncertainBool a) { return {!a.value, a.uncertain}; }
};

template <class Model>
struct Rounded {
  static constexpr double kUnit = 0x1p-24, kUnderflow = 0x1p-126;
  double v, e;  // value; |float - v| <= e

  // An error that is not a number (infinity times zero) gives an infinite bound.
  static Rounded of(double v, double e) { return {v, std::isnan(e) ? std::numeric_limits<double>::infinity() : e}; }
  static Rounded lost(double v) { return of(v, std::numeric_limits<double>::infinity()); }
  // A result of value v after one operation of `units` roundings; its operands contribute the error e.
  static Rounded after(double v, double e, double units) { return of(v, e + units * kUnit * (std::fabs(v) + e) + kUnderflow); }

  friend Rounded operator+(Rounded a, Rounded b) { return after(a.v + b.v, a.e + b.e, 1); }
  friend Rounded operator-(Rounded a, Rounded b) { return after(a.v - b.v, a.e + b.e, 1); }
  friend Rounded operator-(Rounded a) { return {-a.v, a.e}; }
  // Zero times a finite number is exactly zero.
  bool exact_zero() const { return std::fabs(v) + e <= 0; }
  friend Rounded operator*(Rounded a, Rounded b) {
    if ((a.exact_zero() && std::isfinite(b.e)) || (b.exact_zero() && std::isfinite(a.e))) return {0, 0};
    return after(a.v * b.v, a.e * std::fabs(b.v) + b.e * std::fabs(a.v) + a.e * b.e, 1);
  }
  friend Rounded operator/(Rounded a, Rounded b) {
    const double v = a.v / b.v, room = std::fabs(b.v) - b.e;
    if (a.exact_zero() && room > 0) return {0, 0};
    return room > 0 ? after(v, (a.e + std::fabs(v) * b.e) / room, Model::kDivision) : lost(v);
  }
  friend UncertainBool operator<(Rounded a, Rounded b) { return {a.v<b.v, a.e + b.e> 0 && !(std::fabs(a.v - b.v) > a.e + b.e)}; }
  friend UncertainBool operator<=(Rounded a, Rounded b) { return !(b < a); }
};

template <class Model>
struct RealTraits<Rounded<Model>> {
  using R = Rounded<Model>;
  using Scalar = double;
  using Bool = UncertainBool;
  static constexpr int kDigits = 24;

  static R from_double(double x) { return {x, std::fabs(x - static_cast<double>(static_cast<float>(x)))}; }
  static R select(Bool m, R a, R b) {
    const R chosen = m.value ? a : b, other = m.value ? b : a;
    if (!m.uncertain) return chosen;
    const double across = std::fabs(a.v - b.v) + other.e;
    return R::of(chosen.v, across > chosen.e || std::isnan(across) ? across : chosen.e);
  }
  // In a pack a neighbour may need the branch, so its roundings count for all.
  static bool any(Bool) { return true; }
  static bool all(Bool m) { return m.value && !m.uncertain; }
  static R abs(R x) { return {std::fabs(x.v), x.e}; }
  // If the errors cannot change the order, the other side's error does not count.
  static R min(R a, R b) {
    if ((a < b).uncertain) return {std::fmin(a.v, b.v), std::fmax(a.e, b.e)};
    return b.v < a.v ? b : a;
  }
  static R max(R a, R b) { return -min(-a, -b); }
  static R floor(R x) {
    const double v = std::floor(x.v);
    return R::of(v, std::fmax(v - std::floor(x.v - x.e), std::floor(x.v + x.e) - v));
  }
  static R sqrt(R x) {
    const double v = std::sqrt(std::fmax(x.v, 0.0));
    const double low = std::sqrt(std::fmax(x.v - x.e, 0.0)), high = std::sqrt(std::fmax(x.v + x.e, 0.0));
    return R::after(v, std::fmax(v - low, high - v), Model::kRoot);
  }
  static R inversesqrt(R x) {
    const double v = 1 / std::sqrt(x.v);
    return x.v > x.e ? R::after(v, 1 / std::sqrt(x.v - x.e) - v, Model::kInverseRoot) : R::lost(v);
  }
  static R exp(R x) {
    const double v = std::exp(x.v);
    return R::after(v, v * std::expm1(x.e), Model::kExp + Model::kExpPerArgument * (std::fabs(x.v) + x.e));
  }
  static R log(R x) {
    const double v = std::log(x.v);
    if (!(x.v > x.e)) return R::lost(v);
    return R::after(v, -std::log1p(-x.e / x.v) + Model::kLogAbsolute, Model::kLog);
  }
};

STERADIAN_END_ISA
