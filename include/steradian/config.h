// The inline namespace that keeps translation units of different instruction sets apart.
//
// Everything that a kernel touches lives in steradian::STERADIAN_ISA. Units built for AVX2 or AVX-512 define
// STERADIAN_ISA as isa_avx2 or isa_avx512; all others get isa_portable. Two units compiled with different
// machine flags therefore never share a weak symbol that the linker could merge.
#pragma once

#ifndef STERADIAN_ISA
#define STERADIAN_ISA isa_portable
#endif

// The namespace is inline from its first mention on: later ones (source/core/simd.h) only name it.
namespace steradian {
inline namespace STERADIAN_ISA {}
}  // namespace steradian

#define STERADIAN_BEGIN_ISA \
  namespace steradian {     \
  inline namespace STERADIAN_ISA {
#define STERADIAN_END_ISA \
  }                       \
  }

// Kernels are small and called in inner loops on packs: a call that is not inlined spills whole vectors.
#if defined(__GNUC__) || defined(__clang__)
#define STERADIAN_INLINE inline __attribute__((always_inline))
#else
#define STERADIAN_INLINE inline
#endif
