// The intrinsics that emscripten has in 128 bits. WebAssembly has no float mode: denormals are kept.
#pragma once

#include <emmintrin.h>

inline void _mm_setcsr(unsigned) {}
