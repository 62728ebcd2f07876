// Access to the lanes of a pack's mask, one by one.
#pragma once

#include <cstdint>

#include "core/pack.h"

STERADIAN_BEGIN_ISA

#if defined(__aarch64__)
// Bit k in lane k.
STERADIAN_INLINE uint32x4_t lane_bits() { return uint32x4_t{1, 2, 4, 8}; }
#endif

// The mask's lanes as the lowest bits of a number.
STERADIAN_INLINE std::uint32_t bits_of(const PackKernels::mask& m) {
#if defined(__AVX512F__)
  return static_cast<std::uint32_t>(static_cast<__mmask16>(m.m.data));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(m.m));
#elif defined(__aarch64__)
  return vaddvq_u32(vandq_u32(m.m, lane_bits()));
#else
  return static_cast<std::uint32_t>(_mm_movemask_ps(m.m));
#endif
}

// The mask of the lowest bits of a number.
STERADIAN_INLINE PackKernels::mask mask_of(std::uint32_t bits) {
#if defined(__AVX512F__)
  return PackKernels::mask(Pack::batch_bool_type(static_cast<__mmask16>(bits)));
#elif defined(__AVX2__)
  const __m256i one = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(bits)), one);
  return PackKernels::mask(Pack::batch_bool_type(_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, one))));
#elif defined(__aarch64__)
  return PackKernels::mask(Pack::batch_bool_type(vtstq_u32(vdupq_n_u32(bits), lane_bits())));
#else
  const __m128i one = _mm_setr_epi32(1, 2, 4, 8);
  const __m128i set = _mm_and_si128(_mm_set1_epi32(static_cast<int>(bits)), one);
  return PackKernels::mask(Pack::batch_bool_type(_mm_castsi128_ps(_mm_cmpeq_epi32(set, one))));
#endif
}

// Integers with as many lanes as a pack.
using PackInt = xsimd::batch<std::int32_t, PackArch>;

STERADIAN_INLINE PackInt::batch_bool_type int_mask(const PackKernels::mask& m) {
#if defined(__AVX512F__)
  return PackInt::batch_bool_type(m.m.data);
#elif defined(__AVX2__)
  return PackInt::batch_bool_type(_mm256_castps_si256(m.m));
#elif defined(__aarch64__)
  return PackInt::batch_bool_type(static_cast<uint32x4_t>(m.m));
#else
  return PackInt::batch_bool_type(_mm_castps_si128(m.m));
#endif
}
STERADIAN_INLINE std::uint32_t bits_of(const PackInt::batch_bool_type& m) {
#if defined(__AVX512F__)
  return static_cast<std::uint32_t>(static_cast<__mmask16>(m.data));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(m)));
#elif defined(__aarch64__)
  return vaddvq_u32(vandq_u32(m, lane_bits()));
#else
  return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(m)));
#endif
}

// xsimd 8.1's own select does not compile for AVX-512.
STERADIAN_INLINE PackInt select(const PackInt::batch_bool_type& m, const PackInt& a, const PackInt& b) {
#if defined(__AVX512F__)
  return PackInt(_mm512_mask_blend_epi32(m.data, b, a));
#elif defined(__AVX2__)
  return PackInt(_mm256_blendv_epi8(b, a, m));
#elif defined(__aarch64__)
  return PackInt(vbslq_s32(m, a, b));
#else
  return PackInt(_mm_or_si128(_mm_and_si128(m, a), _mm_andnot_si128(m, b)));
#endif
}
STERADIAN_INLINE PackInt select(const PackKernels::mask& m, const PackInt& a, const PackInt& b) { return select(int_mask(m), a, b); }

// Calls use(lane) for each set bit, in ascending order.
template <class Use>
STERADIAN_INLINE void for_each_bit(std::uint32_t bits, Use use) {
  for (; bits != 0; bits &= bits - 1) use(static_cast<std::size_t>(__builtin_ctz(bits)));
}

STERADIAN_END_ISA
