// A blue-noise mask: ranks on a torus whose every threshold leaves points that keep off each other.
#pragma once

#include <array>

namespace steradian::indirect {

inline constexpr int kMaskSide = 64;
using Mask64 = std::array<std::array<float, kMaskSide>, kMaskSide>;

// Every value (k + 1/2) / 4096 once, the same at every call.
// Source: Ulichney, "The void-and-cluster method for dither array generation", 1993.
const Mask64& blue_noise();

}  // namespace steradian::indirect
