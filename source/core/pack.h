// Packs: the kernels' numbers made of SIMD registers. Pack::Real is 4, 8 or 16 floats, by the unit's instruction set.
//
// Only files named *_pack.cpp include this header, since each instruction set has a unit of its own. The accuracy of exp and log is xsimd's
// (a few ulp); that of the arithmetic is the machine's.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "steradian/kernels.h"
#include "steradian/vector.h"

STERADIAN_BEGIN_ISA

#if defined(__AVX512F__)
using PackArch = xsimd::avx512bw;
#elif defined(__AVX2__)
using PackArch = xsimd::fma3<xsimd::avx2>;
#elif defined(__aarch64__)
using PackArch = xsimd::neon64;
#else
using PackArch = xsimd::sse2;
#endif

using Pack = xsimd::batch<float, PackArch>;
inline constexpr std::size_t kLanes = Pack::size;

#if !defined(STERADIAN_STRICT)
// One Newton step y (3 - x y^2) / 2 on the machine's 12- or 14-bit estimate: 2 to 3 ulp, for x in [1e-37, 1e37].
STERADIAN_INLINE Pack refine_inversesqrt(Pack x, Pack y) {
  const Pack half_x = x * Pack(0.5f);
  return y * (Pack(1.5f) - half_x * y * y);
}
#endif

template <>
struct RealTraits<Pack> {
  using Scalar = float;
  using Bool = Pack::batch_bool_type;
  static constexpr int kDigits = 24;

  STERADIAN_INLINE static Pack from_double(double x) { return Pack(static_cast<float>(x)); }
  STERADIAN_INLINE static Pack select(Bool m, Pack a, Pack b) { return xsimd::select(m, a, b); }
  STERADIAN_INLINE static bool any(Bool m) { return xsimd::any(m); }
  STERADIAN_INLINE static bool all(Bool m) { return xsimd::all(m); }
  STERADIAN_INLINE static Pack abs(Pack x) { return xsimd::abs(x); }
  STERADIAN_INLINE static Pack min(Pack a, Pack b) { return xsimd::min(a, b); }
  STERADIAN_INLINE static Pack max(Pack a, Pack b) { return xsimd::max(a, b); }
  STERADIAN_INLINE static Pack floor(Pack x) { return xsimd::floor(x); }
  STERADIAN_INLINE static Pack sqrt(Pack x) { return xsimd::sqrt(x); }
  STERADIAN_INLINE static Pack inversesqrt(Pack x) {
#if defined(STERADIAN_STRICT)
    return Pack(1.0f) / xsimd::sqrt(x);
#elif defined(__AVX512F__)
    return refine_inversesqrt(x, Pack(_mm512_rsqrt14_ps(x)));
#elif defined(__AVX2__)
    return refine_inversesqrt(x, Pack(_mm256_rsqrt_ps(x)));
#elif defined(__aarch64__)
    return refine_inversesqrt(x, refine_inversesqrt(x, Pack(vrsqrteq_f32(x))));  // NEON's estimate has 8 bits
#else
    return refine_inversesqrt(x, Pack(_mm_rsqrt_ps(x)));
#endif
  }
  STERADIAN_INLINE static Pack exp(Pack x) { return xsimd::exp(x); }
  STERADIAN_INLINE static Pack log(Pack x) { return xsimd::log(x); }
};

// Loads and stores of consecutive pixels. The pointers need no alignment.
using PackReal = Real<Pack>;
using PackVec3 = Vec3<PackReal>;
using PackKernels = Kernels<Pack>;

STERADIAN_INLINE PackReal load(const float* p) { return PackReal::of(Pack::load_unaligned(p)); }
STERADIAN_INLINE void store(float* p, PackReal x) { x.v.store_unaligned(p); }
STERADIAN_INLINE PackReal broadcast(float x) { return PackReal::of(Pack(x)); }

STERADIAN_INLINE PackVec3 broadcast(const Vec3f& v) { return {broadcast(v.x), broadcast(v.y), broadcast(v.z)}; }

STERADIAN_END_ISA
