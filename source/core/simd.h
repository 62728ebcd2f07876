// The instruction sets that packs are compiled for, and the choice among them at run time.
#pragma once

#include <string>
#include <vector>

#include "steradian/config.h"

namespace steradian {

enum class Simd { sse2, avx2, avx512 };

const char* name_of(Simd simd);
int lanes_of(Simd simd);

// True if this build contains packs for the set (STERADIAN_INSTRUCTION_SETS of cmake/instruction_sets.cmake).
constexpr bool is_built(Simd simd) {
  switch (simd) {
    case Simd::sse2: return STERADIAN_HAS_SSE2 != 0;
    case Simd::avx2: return STERADIAN_HAS_AVX2 != 0;
    case Simd::avx512: return STERADIAN_HAS_AVX512 != 0;
  }
  return false;
}

// Throws Error that names the set.
[[noreturn]] void throw_not_built(Simd simd);

// Instruction sets that this build contains and this processor can run, narrowest first. Throws Error if there is none.
std::vector<Simd> available_simd();

// The widest available set, or the one that the environment variable STERADIAN_SIMD (sse2, avx2, avx512) forces. Throws Error when the
// variable names another set or one that this processor cannot run.
Simd active_simd();

// Declares the function table of a *_pack.cpp file in every instruction set's namespace, and its choice:
//   STERADIAN_DECLARE_PACK_TABLE(LambertTable, lambert_table)
// The pack file defines `const LambertTable& lambert_table()` in its own namespace; callers use
// lambert_table_for(simd).
#define STERADIAN_DECLARE_PACK_TABLE(Table, function) STERADIAN_DECLARE_PACK_TABLE_IN(, Table, function)

// The same in namespaces isa_sse2SUFFIX and so on, for units of steradian_pack_objects(NAME SUFFIX ...); callers use
// lambert_tableSUFFIX_for(simd).
#define STERADIAN_DECLARE_PACK_TABLE_IN(suffix, Table, function)       \
  namespace isa_sse2##suffix {                                         \
    const Table& function();                                           \
  }                                                                    \
  namespace isa_avx2##suffix {                                         \
    const Table& function();                                           \
  }                                                                    \
  namespace isa_avx512##suffix {                                       \
    const Table& function();                                           \
  }                                                                    \
  inline const Table& function##suffix##_for(Simd simd) {              \
    if constexpr (is_built(Simd::avx512))                              \
      if (simd == Simd::avx512) return isa_avx512##suffix::function(); \
    if constexpr (is_built(Simd::avx2))                                \
      if (simd == Simd::avx2) return isa_avx2##suffix::function();     \
    if constexpr (is_built(Simd::sse2))                                \
      if (simd == Simd::sse2) return isa_sse2##suffix::function();     \
    throw_not_built(simd);                                             \
  }

}  // namespace steradian
