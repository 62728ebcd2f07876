#include "core/simd.h"

#include <cstdlib>

#include "steradian/error.h"
#include "steradian/version.h"

namespace steradian {
namespace {

bool runs(Simd simd) {
  if (!is_built(simd)) return false;
#if !defined(__x86_64__)
  return simd == Simd::sse2;
#else
  __builtin_cpu_init();
  switch (simd) {
    case Simd::sse2: return true;
    case Simd::avx2: return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case Simd::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd");
  }
  return false;
#endif
}

}  // namespace

const char* name_of(Simd simd) {
  switch (simd) {
#if defined(__aarch64__)
    case Simd::sse2: return "neon";
#else
    case Simd::sse2: return "sse2";
#endif
    case Simd::avx2: return "avx2";
    case Simd::avx512: return "avx512";
  }
  return "?";
}

int lanes_of(Simd simd) { return 4 << static_cast<int>(simd); }

void throw_not_built(Simd simd) {
  throw Error("this build", std::string("holds no packs for ") + name_of(simd), "see STERADIAN_INSTRUCTION_SETS");
}

std::vector<Simd> available_simd() {
  std::vector<Simd> result;
  for (Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512})
    if (runs(simd)) result.push_back(simd);
  if (result.empty())
    throw Error("this build", "holds no instruction set that this processor runs", "build with -DSTERADIAN_INSTRUCTION_SETS=sse2");
  return result;
}

Simd active_simd() {
  const char* forced = std::getenv("STERADIAN_SIMD");
  if (forced == nullptr || *forced == '\0') return available_simd().back();
  for (Simd simd : {Simd::sse2, Simd::avx2, Simd::avx512}) {
    if (std::string(forced) != name_of(simd)) continue;
    if (!runs(simd))
      throw Error("STERADIAN_SIMD", std::string(forced) + " does not run on this processor, or is not in this build",
                  std::string("widest here: ") + name_of(available_simd().back()));
    return simd;
  }
  throw Error("STERADIAN_SIMD", std::string("unknown instruction set '") + forced + "'", "use sse2, avx2 or avx512, or unset it");
}

const char* version() { return STERADIAN_VERSION; }

}  // namespace steradian
