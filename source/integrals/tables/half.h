// Half precision: 1 sign, 5 exponent, 10 fraction bits. Rounds to nearest, ties to even; overflow goes to infinity.
#pragma once

#include <cstdint>

namespace steradian {

std::uint16_t half_from_float(float x);
float float_from_half(std::uint16_t bits);
inline float round_to_half(float x) { return float_from_half(half_from_float(x)); }

}  // namespace steradian
