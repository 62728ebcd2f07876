// The lanes of a mask as bits. For *_pack.cpp only.
#pragma once

#include <array>
#include <cstdint>

#include "core/pack.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

STERADIAN_INLINE std::uint32_t bits_of(const Mask<Pack>& mask) {
#if defined(__AVX512F__)
  return static_cast<std::uint32_t>(static_cast<__mmask16>(mask.m));
#elif defined(__AVX__)
  return static_cast<std::uint32_t>(_mm256_movemask_ps(mask.m));
#else
  return static_cast<std::uint32_t>(_mm_movemask_ps(mask.m));
#endif
}

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
