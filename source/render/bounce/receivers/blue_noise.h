// A blue-noise mask: ranks on a torus. At any threshold, the points below it keep away from each other.
#pragma once

#include <array>

namespace steradian::indirect {

inline constexpr int kMaskSide = 64;
using Mask64 = std::array<std::array<float, kMaskSide>, kMaskSide>;

// Contains each value (k + 1/2) / 4096 once. Every call returns the same mask.
//
// Source: Ulichney, "The void-and-cluster method for dither array generation", 1993.
const Mask64& blue_noise();

}  // namespace steradian::indirect
