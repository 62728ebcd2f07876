// Shaken<Model>: a number whose every operation has a random error of up to the size that Model allows: Monte Carlo arithmetic.
//
// Running error analysis (rounded.h) passes on the error of an iteration's start to the next step. It cannot detect that the step forgets
// this error, nor that two nearly equal terms share an error. Where it finds no bound for a kernel, this class provides one. The kernel is
// evaluated several times with different roundings, and the spread of the results tells how far roundings move it. Source: Parker, "Monte
// Carlo arithmetic", 1997.
#pragma once

#include <cmath>
#include <cstdint>

#include "rounded.h"

STERADIAN_BEGIN_ISA

// The source of the roundings. Amplitude 0: none, the algorithm's own value.
struct Shaking {
  double amplitude = 0;
  std::uint64_t state = 0;

  void restart(std::uint64_t seed, double new_amplitude) {
    state = seed;
    amplitude = new_amplitude;
  }
  // Uniform in [-amplitude, amplitude]. Source: Steele, Lea, Flood, "SplitMix", 2014.
  double next() {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return amplitude * (static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.0);
  }
};

inline Shaking& shaking() {
  static thread_local Shaking instance;
  return instance;
}

template <class Model>
struct Shaken {
  double v;

  static Shaken after(double v, double units) { return {v + v * units * 0x1p-24 * shaking().next()}; }
  friend Shaken operator+(Shaken a, Shaken b) { return after(a.v + b.v, 1); }
  friend Shaken operator-(Shaken a, Shaken b) { return after(a.v - b.v, 1); }
  friend Shaken operator-(Shaken a) { return {-a.v}; }
  friend Shaken operator*(Shaken a, Shaken b) { return after(a.v * b.v, 1); }
  friend Shaken operator/(Shaken a, Shaken b) { return after(a.v / b.v, Model::kDivision); }
  friend bool operator<(Shaken a, Shaken b) { return a.v < b.v; }
  friend bool operator<=(Shaken a, Shaken b) { return a.v <= b.v; }
};

template <class Model>
struct RealTraits<Shaken<Model>> {
  using R = Shaken<Model>;
  using Scalar = double;
  using Bool = bool;
  static constexpr int kDigits = 24;

  static R from_double(double x) { return {static_cast<double>(static_cast<float>(x))}; }
  static R select(bool m, R a, R b) { return m ? a : b; }
  static bool any(bool m) { return m; }
  static bool all(bool m) { return m; }
  static R abs(R x) { return {std::fabs(x.v)}; }
  static R min(R a, R b) { return b.v < a.v ? b : a; }
  static R max(R a, R b) { return a.v < b.v ? b : a; }
  static R floor(R x) { return {std::floor(x.v)}; }
  static R sqrt(R x) { return R::after(std::sqrt(x.v), Model::kRoot); }
  static R inversesqrt(R x) { return R::after(1 / std::sqrt(x.v), Model::kInverseRoot); }
  static R exp(R x) { return R::after(std::exp(x.v), Model::kExp + Model::kExpPerArgument * std::fabs(x.v)); }
  static R log(R x) {
    const double v = std::log(x.v);
    return {v + (std::fabs(v) * Model::kLog * 0x1p-24 + Model::kLogAbsolute) * shaking().next()};
  }
};

STERADIAN_END_ISA
