// WebAssembly has one width of packs, 128 bits, as SSE2: nothing is chosen at run time.
#include "core/simd.h"
#include "steradian/error.h"

namespace steradian {

const char* name_of(Simd) { return "wasm"; }
int lanes_of(Simd) { return 4; }
void throw_not_built(Simd) { throw Error("this build", "holds packs of 128 bits only"); }
std::vector<Simd> available_simd() { return {Simd::sse2}; }
Simd active_simd() { return Simd::sse2; }

}  // namespace steradian
