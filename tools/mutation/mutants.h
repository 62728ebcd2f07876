// What tools/mutate.py writes into the kernels: each site has a number, and a run of the tests breaks the one that the environment's
// STERADIAN_MUTANT names. One build so serves all mutants. Included before everything else, and by no other build.
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

// A sign before what is added or subtracted.
struct Sign {
  bool flipped;
};
inline Sign sign(int site) { return {on(site)}; }
template <class T>
T operator*(Sign s, const T& x) {
  return s.flipped ? T(-x) : x;
}

// What is multiplied by or divided by: its reciprocal, so that product and quotient change places; of what has none, its opposite.
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
