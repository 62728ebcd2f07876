// The instruction sets that packs are compiled for, and the choice among them at run time.
#pragma once

#include <string>
#include <vector>

#include "steradian/config.h"

namespace steradian {

enum class Simd { sse2, avx2, avx512 };

const char* name_of(Simd simd);
int lanes_of(Simd simd);

// What this processor can run, narrowest first.
std::vector<Simd> available_simd();

// The widest available, or what the environment variable STERADIAN_SIMD (sse2, avx2, avx512) forces.
// Throws Error when the variable names something else or something this processor cannot run.
Simd active_simd();

// Declares the function table of a *_pack.cpp file in every instruction set's namespace, and its choice:
//   STERADIAN_DECLARE_PACK_TABLE(LambertTable, lambert_table)
// The pack file defines `const LambertTable& lambert_table()` in its own namespace; callers use
// lambert_table_for(simd).
#define STERADIAN_DECLARE_PACK_TABLE(Table, function)                \
  namespace isa_sse2 {                                               \
  const Table& function();                                           \
  }                                                                  \
  namespace isa_avx2 {                                               \
  const Table& function();                                           \
  }                                                                  \
  namespace isa_avx512 {                                             \
  const Table& function();                                           \
  }                                                                  \
  inline const Table& function##_for(Simd simd) {                    \
    switch (simd) {                                                  \
      case Simd::sse2: return isa_sse2::function();                  \
      case Simd::avx2: return isa_avx2::function();                  \
      case Simd::avx512: return isa_avx512::function();              \
    }                                                                \
    return isa_sse2::function();                                     \
  }

}  // namespace steradian
