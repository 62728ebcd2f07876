// Far pairs on packs of doubles. A lane is a column of the matrix, so that the value of a pair depends on nothing else.
#include "core/pack_double.h"
#include "exchange/pairs/far_pairs.h"

STERADIAN_BEGIN_ISA
namespace {

using exchange::kLargestProduct;
using exchange::kNoExchange;
using exchange::kOneByOne;
using N = exchange::ElementArrays::Name;

constexpr std::size_t kWide = PackD::size;
constexpr double kPi = 3.14159265358979324;
// Heights below this fraction of the distance are rounding, as for cut_element.
constexpr double kFlat = 0x1p-46;
// Rounding of a product rule, relative to A1 A2 / (pi R^2): 16 operations.
constexpr double kProductRounding = 0x1p-49;
constexpr std::size_t kMostNodesASide = kLargestProduct * kLargestProduct;

STERADIAN_INLINE PackD load_d(const double* p) { return PackD::load_unaligned(p); }
STERADIAN_INLINE PackD all(double x) { return PackD(x); }

__attribute__((flatten)) void classify(const double* numbers, std::size_t stride, std::size_t row, std::size_t columns, double eps,
                                       std::uint8_t* method, double* error) {
  const auto at_row = [&](std::size_t name) { return all(numbers[name * stride + row]); };
  const PackD zero(0.0), one(1.0), two(2.0), half(0.5);
  const PackD ix = at_row(N::center_x), iy = at_row(N::center_y), iz = at_row(N::center_z), nx = at_row(N::normal_x),
              ny = at_row(N::normal_y), nz = at_row(N::normal_z), ux = at_row(N::reach_x), uy = at_row(N::reach_y), uz = at_row(N::reach_z),
              vx = at_row(N::span_x), vy = at_row(N::span_y), vz = at_row(N::span_z), radius_i = at_row(N::radius),
              kind_i = at_row(N::kind), area_i = at_row(N::area), off_i = at_row(N::off_plane), skew_i = at_row(N::skew);
  // The least and the largest height of an element about its centre, from its two vectors along the normal: a parallelogram's are
  // -+ (|a| + |b|), a triangle's corners are a, b and -a - b.
  const auto extent = [&](PackD a, PackD b, PackD kind, PackD radius, PackD& low, PackD& high) {
    const PackD sum = xsimd::abs(a) + xsimd::abs(b), third = -a - b;
    low = xsimd::select(kind < half, -sum, xsimd::min(xsimd::min(a, b), third));
    high = xsimd::select(kind < half, sum, xsimd::max(xsimd::max(a, b), third));
    low = xsimd::select(kind > one, -radius, low);
    high = xsimd::select(kind > one, radius, high);
  };
  alignas(64) double level_of[kWide], error_of[kWide];
  for (std::size_t j = 0; j < columns; j += kWide) {
    const auto at = [&](std::size_t name) { return load_d(numbers + name * stride + j); };
    const PackD rx = at(N::center_x) - ix, ry = at(N::center_y) - iy, rz = at(N::center_z) - iz;
    const PackD mx = at(N::normal_x), my = at(N::normal_y), mz = at(N::normal_z), radius_j = at(N::radius), kind_j = at(N::kind);
    const PackD r2 = rx * rx + ry * ry + rz * rz, r = xsimd::sqrt(r2),
                flat = all(kFlat) * (r + radius_i + radius_j) + all(exchange::kInPlane) * (off_i + at(N::off_plane));
    const PackD over_i = rx * nx + ry * ny + rz * nz, over_j = -(rx * mx + ry * my + rz * mz);
    PackD low_j, high_j, low_i, high_i;
    extent(at(N::reach_x) * nx + at(N::reach_y) * ny + at(N::reach_z) * nz, at(N::span_x) * nx + at(N::span_y) * ny + at(N::span_z) * nz,
           kind_j, radius_j, low_j, high_j);
    extent(ux * mx + uy * my + uz * mz, vx * mx + vy * my + vz * mz, kind_i, radius_i, low_i, high_i);
    const auto behind = (over_i + high_j <= flat) || (over_j + high_i <= flat);
    const PackD distance = r - radius_i - radius_j, safe = xsimd::max(distance, all(1e-300));
    const auto in_front = (over_i + low_j >= -flat) && (over_j + low_i >= -flat) && (distance > zero) && (kind_i < two) && (kind_j < two);
    const PackD facing = xsimd::max(over_i, zero) * xsimd::max(over_j, zero) / xsimd::max(r2, all(1e-300));
    // The error that is enough, relative to A1 A2 / (pi R^2) for the least distance R.
    const PackD enough = all(eps) * facing * (safe * safe) / xsimd::max(r2, all(1e-300)) - all(kProductRounding);
    const auto is_triangle_i = kind_i > half, is_triangle_j = kind_j > half;
    const PackD base_i = radius_i / (safe + xsimd::select(is_triangle_i, radius_i, zero)),
                base_j = radius_j / (safe + xsimd::select(is_triangle_j, radius_j, zero));
    PackD power_i = xsimd::select(is_triangle_i, one / base_i, one), power_j = xsimd::select(is_triangle_j, one / base_j, one);
    PackD level(static_cast<double>(kOneByOne)), bound = zero;
    const PackD skewed = (skew_i + at(N::skew)) / safe;
    for (std::size_t m = 1; m <= kLargestProduct; ++m) {
      power_i = power_i * base_i * base_i;
      power_j = power_j * base_j * base_j;
      const PackD now = at_row(N::remainder_1 + m - 1) * power_i + at(N::remainder_1 + m - 1) * power_j + skewed;
      const auto serves = (level > all(static_cast<double>(kLargestProduct))) && (now <= enough);
      level = xsimd::select(serves, all(static_cast<double>(m)), level);
      bound = xsimd::select(serves, now, bound);
    }
    level = xsimd::select(in_front, level, all(static_cast<double>(kOneByOne)));
    level = xsimd::select(behind, zero, level);
    const PackD scale = area_i * at(N::area) / (all(kPi) * safe * safe);
    (scale * (bound + all(kProductRounding))).store_aligned(error_of);
    level.store_aligned(level_of);
    for (std::size_t lane = 0; lane < kWide; ++lane) {
      method[j + lane] = static_cast<std::uint8_t>(level_of[lane]);
      error[j + lane] = error_of[lane];
    }
  }
}

// 1 / r^4.
STERADIAN_INLINE PackD fourth_power_below(PackD r2) {
#if defined(__AVX512F__)
  const PackD y = RealTraits<PackD>::inversesqrt(r2), y2 = y * y;
  return y2 * y2;
#else
  return PackD(1.0) / (r2 * r2);
#endif
}

__attribute__((flatten)) void integrate(const double* numbers, std::size_t stride, std::size_t row, bool row_is_triangle,
                                        const std::uint32_t* columns, std::size_t count, bool triangles, std::size_t n, const double* nodes,
                                        const double* weights, double* values) {
  const auto number = [&](std::size_t name, std::size_t i) { return numbers[name * stride + i]; };
  // The row's nodes, about its centre.
  double px[kMostNodesASide], py[kMostNodesASide], pz[kMostNodesASide], pw[kMostNodesASide];
  const double cx = number(N::center_x, row), cy = number(N::center_y, row), cz = number(N::center_z, row);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t p = i * n + k;
      const double s = nodes[i], t = row_is_triangle ? s * nodes[k] : nodes[k];
      px[p] = (number(N::origin_x, row) - cx) + number(N::a_x, row) * s + number(N::b_x, row) * t;
      py[p] = (number(N::origin_y, row) - cy) + number(N::a_y, row) * s + number(N::b_y, row) * t;
      pz[p] = (number(N::origin_z, row) - cz) + number(N::a_z, row) * s + number(N::b_z, row) * t;
      pw[p] = weights[i] * weights[k] * (row_is_triangle ? 2 * s : 1.0);
    }
  const PackD nx = all(number(N::normal_x, row)), ny = all(number(N::normal_y, row)), nz = all(number(N::normal_z, row));
  constexpr std::size_t kGathered = 16;
  constexpr std::size_t names[kGathered] = {N::center_x, N::center_y, N::center_z, N::normal_x, N::normal_y, N::normal_z,
                                            N::origin_x, N::origin_y, N::origin_z, N::a_x,      N::a_y,      N::a_z,
                                            N::b_x,      N::b_y,      N::b_z,      N::area};
  alignas(64) double gathered[kGathered][kWide], sums[kWide];
  for (std::size_t first = 0; first < count; first += kWide) {
    const std::size_t lanes = count - first < kWide ? count - first : kWide;
    for (std::size_t g = 0; g < kGathered; ++g)
      for (std::size_t lane = 0; lane < kWide; ++lane)
        gathered[g][lane] = numbers[names[g] * stride + columns[first + (lane < lanes ? lane : 0)]];
    const auto at = [&](std::size_t g) { return PackD::load_aligned(gathered[g]); };
    const PackD jx = at(0) - all(cx), jy = at(1) - all(cy), jz = at(2) - all(cz), mx = at(3), my = at(4), mz = at(5);
    const PackD ox = at(6) - all(cx), oy = at(7) - all(cy), oz = at(8) - all(cz);
    const PackD ax = at(9), ay = at(10), az = at(11), bx = at(12), by = at(13), bz = at(14);
    // Heights of the row's nodes over the column's plane, with their weights.
    PackD height[kMostNodesASide];
    for (std::size_t p = 0; p < n * n; ++p)
      height[p] = all(pw[p]) * ((all(px[p]) - jx) * mx + (all(py[p]) - jy) * my + (all(pz[p]) - jz) * mz);
    PackD sum(0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        const PackD s = all(nodes[i]), t = all(triangles ? nodes[i] * nodes[k] : nodes[k]);
        const PackD qx = ox + ax * s + bx * t, qy = oy + ay * s + by * t, qz = oz + az * s + bz * t;
        PackD inner(0.0);
        for (std::size_t p = 0; p < n * n; ++p) {
          const PackD x = qx - all(px[p]), y = qy - all(py[p]), z = qz - all(pz[p]);
          inner = inner + height[p] * fourth_power_below(x * x + y * y + z * z);
        }
        sum = sum + all(weights[i] * weights[k] * (triangles ? 2 * nodes[i] : 1.0)) * (qx * nx + qy * ny + qz * nz) * inner;
      }
    (sum * at(15) * all(number(N::area, row) / kPi)).store_aligned(sums);
    for (std::size_t lane = 0; lane < lanes; ++lane) values[first + lane] = sums[lane];
  }
}

}  // namespace

const exchange::FarPairs& far_pairs() {
  static constexpr exchange::FarPairs table = {classify, integrate};
  return table;
}

STERADIAN_END_ISA
