#include "core/pack_double.h"
#include "plane/bounce/rows.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

void evaluate(EndColumns& ends) {
  for (std::size_t i = ends.count; i % PackD::size != 0; ++i) ends.t[i] = 0;
  for (std::size_t i = 0; i < ends.count; i += PackD::size) {
    const PackD t = PackD::load_unaligned(ends.t.data() + i), root = xsimd::sqrt(PackD(1.0) + t * t), cosine = PackD(1.0) / root;
    (t * cosine).store_unaligned(ends.sine.data() + i);
    cosine.store_unaligned(ends.cosine.data() + i);
    // asinh is odd: the absolute value loses no digits for negative t.
    const PackD area = xsimd::log(xsimd::abs(t) + root);
    xsimd::copysign(area, t).store_unaligned(ends.area.data() + i);
  }
}

// Sums two rows of four, or one pack of both.
std::array<double, 4> gather(std::span<const std::uint32_t> elements, const ElementWeight* weights, const ElementLine* lines) {
  std::array<double, 8> sum{};
  const std::size_t count = elements.size();
#if defined(__AVX512F__)
  PackD sums[4] = {PackD(0.0), PackD(0.0), PackD(0.0), PackD(0.0)};
  const auto term = [&](std::size_t i) {
    const PackD weight(_mm512_mask_blend_pd(0xf0, _mm512_set1_pd(weights[i].constant), _mm512_set1_pd(weights[i].slope)));
    return weight * PackD::load_aligned(lines[elements[i]].constant);
  };
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (std::size_t k = 0; k < 4; ++k) sums[k] += term(i + k);
  for (; i < count; ++i) sums[0] += term(i);
  ((sums[0] + sums[1]) + (sums[2] + sums[3])).store_unaligned(sum.data());
#else
  constexpr std::size_t kPacks = 4 / PackD::size;
  PackD constants[kPacks], slopes[kPacks];
  for (std::size_t k = 0; k < kPacks; ++k) constants[k] = slopes[k] = PackD(0.0);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < kPacks; ++k) {
      const ElementLine& line = lines[elements[i]];
      constants[k] += PackD(weights[i].constant) * PackD::load_aligned(line.constant + k * PackD::size);
      slopes[k] += PackD(weights[i].slope) * PackD::load_aligned(line.slope + k * PackD::size);
    }
  for (std::size_t k = 0; k < kPacks; ++k) {
    constants[k].store_unaligned(sum.data() + k * PackD::size);
    slopes[k].store_unaligned(sum.data() + 4 + k * PackD::size);
  }
#endif
  return {sum[0] + sum[4], sum[1] + sum[5], sum[2] + sum[6], sum[3] + sum[7]};
}

}  // namespace

const RowsTable& rows_table() {
  static constexpr RowsTable table = {evaluate, gather};
  return table;
}

}  // namespace steradian::plane::STERADIAN_ISA
