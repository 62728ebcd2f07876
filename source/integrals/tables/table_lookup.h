// Bilinear look-up in a square table whose nodes lie on its ends, in double or in a dual number.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA

// Four nodes and their weights.
template <class S>
struct Stencil {
  std::array<std::size_t, 4> index;
  std::array<Real<S>, 4> weight;
};

inline double value_of(double x) { return x; }
template <class S>
double value_of(const S& x) {
  return x.v;
}

//   u, v     along a row and from row to row, in [0, 1]
//   n        nodes a side
template <class S>
Stencil<S> stencil(Real<S> u, Real<S> v, int n) {
  const Real<S> last(n - 1.0), before(n - 2.0), one(1.0);
  const Real<S> x = clamp(u, 0.0, 1.0) * last, y = clamp(v, 0.0, 1.0) * last;
  const Real<S> i = min(floor(x), before), j = min(floor(y), before);
  const Real<S> fx = x - i, fy = y - j;
  const auto row = static_cast<std::size_t>(n);
  const std::size_t base = static_cast<std::size_t>(value_of(j.v)) * row + static_cast<std::size_t>(value_of(i.v));
  return {{base, base + 1, base + row, base + row + 1}, {(one - fx) * (one - fy), fx * (one - fy), (one - fx) * fy, fx * fy}};
}

// Stencil of a table of n nodes a side, with roughness along a row.
template <class S>
Stencil<S> ltc_stencil(Real<S> roughness, Real<S> cos_theta, int n) {
  const auto at = Kernels<S>().ltc_coordinates(roughness, cos_theta);
  return stencil<S>(at.x, at.y, n);
}

template <class S, std::size_t N>
typename Kernels<S>::vec4 interpolate(const std::vector<std::array<float, N>>& table, const Stencil<S>& s) {
  std::array<Real<S>, 4> sum{0.0, 0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < N; ++c) sum[c] += s.weight[k] * Real<S>(static_cast<double>(table[s.index[k]][c]));
  return {sum[0], sum[1], sum[2], sum[3]};
}

STERADIAN_END_ISA
