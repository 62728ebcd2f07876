// The lanes of a pack's mask, one by one.
#pragma once

#include <cstdint>

#include "core/pack.h"

STERADIAN_BEGIN_ISA

// As the lowest bits of a number.
STERADIAN_INLINE std::uint32_t bits_of(const PackKernels::mask& m) {
#if defined(__AVX512F__)
  return static_cast<std::uint32_t>(static_cast<__mmask16>(m.m.data));
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(m.m));
#else
  return static_cast<std::uint32_t>(_mm_movemask_ps(m.m));
#endif
}

// use(lane), ascending.
template <class Use>
STERADIAN_INLINE void for_each_bit(std::uint32_t bits, Use use) {
  for (; bits != 0; bits &= bits - 1) use(static_cast<std::size_t>(__builtin_ctz(bits)));
}

STERADIAN_END_ISA
