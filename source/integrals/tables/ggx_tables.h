// The shipped tables of GGX and of Charlie's sheen. Their text is the fitter's own output, see ggx_tables.cpp.
#pragma once

#include <cmath>
#include <type_traits>

#include "integrals/ggx/ltc.h"
#include "integrals/tables/table.h"
#include "integrals/tables/table_lookup.h"

namespace steradian {

const ClassicTable& ggx_classic_table();
const CompactTable& ggx_compact_table();
const ClassicTable& ggx_fresnel_table();  // for the lobe times (1 - v.h)^5
const CompactTable& charlie_compact_table();

// The shipped tables of linearly transformed cosines, read for one view in the arithmetic of an integral.

// Number type of table look-ups: a lobe in float is read in double and rounded at the end.
template <class S>
using TableNumber = std::conditional_t<std::is_same_v<S, float>, double, S>;

template <class S, class T>
Real<S> rounded(Real<T> x) {
  if constexpr (std::is_same_v<S, T>)
    return x;
  else
    return Real<S>(static_cast<double>(x.v));
}

//   alpha    at least kSmallestAlpha
//   cosine   of the view, which is (s, 0, c) in the shading frame
template <class S>
integrals::LtcLobe<S> classic_lobe(const ClassicTable& table, double alpha, Real<TableNumber<S>> cosine) {
  using T = TableNumber<S>;
  const auto at = Kernels<T>().ltc_coordinates(std::sqrt(alpha), cosine);
  const auto s = stencil<T>(at.x, at.y, table.size);
  const auto m = interpolate<T>(table.matrix, s), f = interpolate<T>(table.magnitude, s);
  return {Kernels<S>().ltc_from_classic({rounded<S>(m.x), rounded<S>(m.y), rounded<S>(m.z), rounded<S>(m.w)}), rounded<S>(f.x),
          rounded<S>(f.y)};
}

template <class S>
integrals::LtcLobe<S> compact_lobe(const CompactTable& table, double alpha, Real<TableNumber<S>> cosine,
                                   const typename Kernels<S>::vec3& view) {
  using T = TableNumber<S>;
  using vec3 = typename Kernels<S>::vec3;
  const auto at = Kernels<T>().ltc_coordinates(std::sqrt(alpha), cosine);
  const auto e = interpolate<T>(table.shapes, stencil<T>(at.x, at.y, table.shape_size));
  const auto f = interpolate<T>(table.magnitudes, stencil<T>(at.x, at.y, table.magnitude_size));
  const bool mirror = table.frame == LobeFrame::mirror;
  return {Kernels<S>().ltc_from_compact({rounded<S>(e.x), rounded<S>(e.y), rounded<S>(e.z), rounded<S>(e.w)}, mirror ? alpha : 1.0,
                                        mirror ? view : vec3(0.0, 0.0, 1.0)),
          rounded<S>(f.x), rounded<S>(f.y)};
}

}  // namespace steradian
