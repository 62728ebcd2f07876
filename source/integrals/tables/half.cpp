#include "integrals/tables/half.h"

#include <bit>
#include <cmath>

namespace steradian {

std::uint16_t half_from_float(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000u);
  const float a = std::fabs(x);
  if (std::isnan(x)) return static_cast<std::uint16_t>(sign | 0x7e00u);
  if (a >= 65520.0f) return static_cast<std::uint16_t>(sign | 0x7c00u);
  // Below 2^-14 the spacing is constant, 2^-24: adding 0.5 moves the rounding there.
  if (a < 0x1p-14f) return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(a + 0.5f) & 0x7fffu));
  std::uint32_t m = std::bit_cast<std::uint32_t>(a);
  m += 0xfffu + ((m >> 13) & 1u);  // rounds the 13 bits that are dropped
  return static_cast<std::uint16_t>(sign | ((m - (112u << 23)) >> 13));
}

float float_from_half(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 31;
  const int fraction = bits & 0x3ff;
  float a = 0;
  if (exponent == 31)
    a = fraction ? NAN : INFINITY;
  else if (exponent == 0)
    a = std::ldexp(static_cast<float>(fraction), -24);
  else
    a = std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
  return bits & 0x8000 ? -a : a;
}

}  // namespace steradian
