// Helpers that tools/mutate.py inserts into the kernels. Each site has a number. A run of the tests breaks the site that the environment's
// STERADIAN_MUTANT names, so one build serves all mutants. This file is included before everything else, and by no other build.
#pragma once

#include <cstdlib>
#include <type_traits>

namespace mutated {

inline const int broken = std::getenv("STERADIAN_MUTANT") != nullptr ? std::atoi(std::getenv("STERADIAN_MUTANT")) : -1;
inline bool reached[STERADIAN_MUTANTS] = {};

inline bool on(int site) {
  reached[site] = true;
  return site == broken;
}

// A sign before an added or subtracted term.
struct Sign {
  bool flipped;
};
inline Sign sign(int site) { return {on(site)}; }
template <class T>
T operator*(Sign s, const T& x) {
  return s.flipped ? T(-x) : x;
}

// A mutated factor or divisor: its reciprocal, so that product and quotient change places. Types without a reciprocal use the opposite.
template <class T>
T factor(int site, const T& x) {
  if (!on(site)) return x;
  if constexpr (std::is_integral_v<T>)
    return x + 1;
  else if constexpr (requires { T(1.0 / x); })
    return T(1.0 / x);
  else
    return T(-x);
}

// A constant, a tenth larger; 0 becomes 1.
inline double constant(int site, double x) { return on(site) ? (x == 0 ? 1 : 1.1 * x) : x; }

// A condition, negated.
template <class M>
M condition(int site, const M& m) {
  return on(site) ? M(!m) : m;
}

}  // namespace mutated
