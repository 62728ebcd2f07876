#include "plane/frame/tiles/cull.h"

#include <bit>
#include <cstdint>

#include "core/pack_bits.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

using PackMask = Mask<Pack>;

STERADIAN_INLINE void append(const BlockerList& from, std::size_t first, std::uint64_t bits, BlockerList& to) {
#if defined(__AVX512F__)
  const auto mask = static_cast<__mmask16>(bits);
  const auto move = [&](const std::vector<float>& a, std::vector<float>& b) {
    _mm512_storeu_ps(b.data() + to.size, _mm512_maskz_compress_ps(mask, _mm512_loadu_ps(a.data() + first)));
  };
  move(from.x, to.x);
  move(from.y, to.y);
  move(from.radius, to.radius);
  move(from.core, to.core);
  _mm512_storeu_si512(to.index.data() + to.size, _mm512_maskz_compress_epi32(mask, _mm512_loadu_si512(from.index.data() + first)));
  to.size += static_cast<std::size_t>(std::popcount(bits));
#else
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(bits));
    to.x[to.size] = from.x[i];
    to.y[to.size] = from.y[i];
    to.radius[to.size] = from.radius[i];
    to.core[to.size] = from.core[i];
    to.index[to.size++] = from.index[i];
  }
#endif
}

__attribute__((flatten)) std::size_t cull(const HullOfCircles& hull, const BlockerList& from, std::size_t begin, std::size_t end,
                                          BlockerList& to, int* hiders) {
  std::size_t hider_count = 0;
  const PackReal ax = broadcast(hull.axis_x), ay = broadcast(hull.axis_y);
  for (std::size_t i = begin; i < end; i += kLanes) {
    const PackReal x = load(from.x.data() + i) - broadcast(hull.x), y = load(from.y.data() + i) - broadcast(hull.y);
    const PackReal radius = load(from.radius.data() + i);
    const PackReal t = clamp((x * ax + y * ay) * broadcast(hull.inverse_length2), PackReal(0.0), PackReal(1.0));
    const PackReal off_x = x - ax * t, off_y = y - ay * t;
    const PackReal half = broadcast(hull.base) + t * broadcast(hull.growth);
    const PackReal limit = (half + radius) * broadcast(hull.widen);
    // Blockers beyond the range of float are included.
    const PackReal off2 = off_x * off_x + off_y * off_y;
    const PackMask touches = !(off2 > limit * limit);
    const std::uint64_t valid = end - i >= kLanes ? ~std::uint64_t{0} : (std::uint64_t{1} << (end - i)) - 1;
    const std::uint64_t bits = bits_of(touches) & valid;
    if (bits == 0) continue;
    // To occlude the light a blocker must reach across the hull.
    const PackReal across = load(from.core.data() + i) - PackReal(0.7) * half;
    const PackMask wide = across > PackReal(0.0) && off2 < across * across;
    for (std::uint64_t h = bits & bits_of(wide); h != 0; h &= h - 1)
      hiders[hider_count++] = from.index[i + static_cast<std::size_t>(std::countr_zero(h))];
    append(from, i, bits, to);
  }
  return hider_count;
}

}  // namespace

const BlockerCullTable& cull_table() {
  static constexpr BlockerCullTable table = {cull};
  return table;
}

}  // namespace steradian::plane::STERADIAN_ISA
