// WebAssembly has one width of packs, 128 bits, as SSE2: nothing is chosen at run time.
#include <system_error>

#include "core/simd.h"
#include "steradian/error.h"

namespace steradian {

const char* name_of(Simd) { return "wasm"; }
int lanes_of(Simd) { return 4; }
void throw_not_built(Simd) { throw Error("this build", "holds packs of 128 bits only"); }
std::vector<Simd> available_simd() { return {Simd::sse2}; }
Simd active_simd() { return Simd::sse2; }

}  // namespace steradian

// The library of C++ would print why it ends the program. A page has no terminal, and the message brings printf along.
extern "C" [[noreturn]] void abort_message(const char*, ...) { __builtin_trap(); }
_LIBCPP_BEGIN_NAMESPACE_STD
[[noreturn]] void __throw_system_error(int, const char*) { __builtin_trap(); }
_LIBCPP_END_NAMESPACE_STD
