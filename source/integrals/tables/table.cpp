#include "integrals/tables/table.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "integrals/tables/ggx_tables.h"
#include "integrals/tables/table_lookup.h"
#include "lobes/fitted.h"
#include "steradian/material.h"  // alpha_from_roughness

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

LtcValue ClassicTable::look_up(double roughness, double cos_theta) const {
  const auto s = ltc_stencil<double>(roughness, cos_theta, size);
  const auto m = interpolate<double>(matrix, s), f = interpolate<double>(magnitude, s);
  if (normalisation == ClassicNormalisation::last) return {{m.x.v, m.z.v, m.w.v, m.y.v, 1.0}, f.x.v, f.y.v};
  return {{m.x.v, m.z.v, 1.0, m.y.v, m.w.v}, f.x.v, f.y.v};
}

CompactTable::Entry CompactTable::entry(double roughness, double cos_theta) const {
  const auto e = interpolate<double>(shapes, ltc_stencil<double>(roughness, cos_theta, shape_size));
  const auto f = interpolate<double>(magnitudes, ltc_stencil<double>(roughness, cos_theta, magnitude_size));
  return {{e.x.v, e.y.v, e.z.v, e.w.v}, f.x.v, f.y.v};
}

LtcValue CompactTable::look_up(double roughness, double cos_theta) const {
  const Entry e = entry(roughness, cos_theta);
  const Vec3d view = view_from_cosine(cos_theta);
  return {ltc_inverse(e.shape, frame, alpha_from_roughness(roughness), view), e.n_a, e.f_a};
}

}  // namespace steradian

namespace steradian::lobes {

FittedEntry read_fitted(const ClassicTable& table, double alpha, double cosine) {
  const auto lobe = classic_lobe<double>(table, std::max(alpha, kSmallestAlpha), cosine);
  return {lobe.matrix, lobe.n_a.v, lobe.f_a.v};
}

}  // namespace steradian::lobes
