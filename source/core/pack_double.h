// Packs of doubles, with half as many lanes as pack.h's. As there, only *_pack.cpp files include this header.
#pragma once

#include "core/pack.h"

STERADIAN_BEGIN_ISA

using PackD = xsimd::batch<double, PackArch>;

template <>
struct RealTraits<PackD> {
  using Scalar = double;
  using Bool = PackD::batch_bool_type;
  static constexpr int kDigits = 53;

  STERADIAN_INLINE static PackD from_double(double x) { return PackD(x); }
  STERADIAN_INLINE static PackD select(Bool m, PackD a, PackD b) { return xsimd::select(m, a, b); }
  STERADIAN_INLINE static bool any(Bool m) { return xsimd::any(m); }
  STERADIAN_INLINE static bool all(Bool m) { return xsimd::all(m); }
  STERADIAN_INLINE static PackD abs(PackD x) { return xsimd::abs(x); }
  STERADIAN_INLINE static PackD min(PackD a, PackD b) { return xsimd::min(a, b); }
  STERADIAN_INLINE static PackD max(PackD a, PackD b) { return xsimd::max(a, b); }
  STERADIAN_INLINE static PackD floor(PackD x) { return xsimd::floor(x); }
  STERADIAN_INLINE static PackD sqrt(PackD x) { return xsimd::sqrt(x); }
  // Two Newton steps on the machine's 14-bit estimate, where it has one: 2 ulp.
  STERADIAN_INLINE static PackD inversesqrt(PackD x) {
#if defined(__AVX512F__)
    const PackD half_x = x * PackD(0.5);
    PackD y(_mm512_rsqrt14_pd(x));
    y = y * (PackD(1.5) - half_x * y * y);
    return y * (PackD(1.5) - half_x * y * y);
#else
    return PackD(1.0) / xsimd::sqrt(x);
#endif
  }
  STERADIAN_INLINE static PackD exp(PackD x) { return xsimd::exp(x); }
  STERADIAN_INLINE static PackD log(PackD x) { return xsimd::log(x); }
};

STERADIAN_END_ISA
