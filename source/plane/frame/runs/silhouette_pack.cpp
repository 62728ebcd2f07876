#include "plane/frame/runs/silhouette.h"

#include <cstddef>

#include "core/pack.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

using Doubles = xsimd::batch<double, PackArch>;

STERADIAN_INLINE unsigned bits_of(const Doubles::batch_bool_type& mask) {
#if defined(__AVX512F__)
  return static_cast<unsigned>(static_cast<__mmask8>(mask));
#elif defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_pd(mask));
#elif defined(__aarch64__)
  return static_cast<unsigned>(vaddvq_u64(vandq_u64(mask, uint64x2_t{1, 2})));
#else
  return static_cast<unsigned>(_mm_movemask_pd(mask));
#endif
}

// Bits of a test on all vertices, and on some beyond the last.
template <class Test>
STERADIAN_INLINE unsigned bits_where(const Silhouette& s, Test test) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < s.count; i += Doubles::size)
    bits |= bits_of(test(Doubles::load_aligned(s.x + i), Doubles::load_aligned(s.y + i), i)) << i;
  return bits;
}

void outline(const PaddedOutline& from, const TileRectangle& tile, Silhouette& s) {
  // Visibility of the outer face of the edge that begins in a vertex: from all of the tile, from none, or from a part.
  unsigned seen = 0, unseen = 0;
  for (std::size_t i = 0; i < PaddedOutline::kMost; i += Doubles::size) {
    const Doubles cx(tile.center.x), cy(tile.center.y);
    const Doubles x = Doubles::load_unaligned(from.x + i) - cx, y = Doubles::load_unaligned(from.y + i) - cy;
    x.store_aligned(s.x + i);
    y.store_aligned(s.y + i);
    const Doubles out_x = Doubles::load_unaligned(from.y + i + 1) - cy - y, out_y = x - (Doubles::load_unaligned(from.x + i + 1) - cx);
    const Doubles at = out_x * x + out_y * y, reach = xsimd::abs(out_x) * Doubles(tile.half.x) + xsimd::abs(out_y) * Doubles(tile.half.y);
    seen |= bits_of(-at > reach) << i;
    unseen |= bits_of(at > reach) << i;
  }
  s.count = static_cast<std::uint8_t>(from.count);
  const unsigned all = (1u << s.count) - 1, last = static_cast<unsigned>(s.count) - 1;
  seen &= all;
  unseen &= all;
  s.outside = seen != 0;
  if (s.count == 2) {
    // A segment has exactly the two faces of one edge.
    seen = (seen & 1) | (unseen & 1) << 1;
    unseen = (seen & 1) << 1 | seen >> 1;
  }
  const auto before = [&](unsigned faces) { return (faces << 1 | faces >> last) & all; };
  s.begins = static_cast<std::uint16_t>(~before(unseen) & ~seen & all);
  s.ends = static_cast<std::uint16_t>(~before(seen) & ~unseen & all);
}

VertexMarks mark(const Silhouette& s, const SeenEmitter& light) {
  const unsigned all = (1u << s.count) - 1;
  const auto past = [&](const HullSide& side) {
    return all & bits_where(s, [&](Doubles x, Doubles y, std::size_t) {
             return x * Doubles(side.normal.x) + y * Doubles(side.normal.y) > Doubles(side.offset);
           });
  };
  const auto before = [&](const HullSide& side) {
    return bits_where(s, [&](Doubles x, Doubles y, std::size_t) {
      const Doubles along = x * Doubles(side.forward.x) + y * Doubles(side.forward.y);
      return along < Doubles(side.limit) && along > Doubles(side.least);
    });
  };
  unsigned ahead;
  if (light.edge) {
    ahead = bits_where(s, [&](Doubles x, Doubles y, std::size_t) {
      return x * Doubles(-light.normal.x) + y * Doubles(-light.normal.y) > Doubles(light.margin);
    });
  } else {
    // A vertex is in front of a pixel's axis if it is outside the circle over the light's centre and the vertex (Thales). Over all pixels:
    // v + l| > |v - l| + 2 margin, squared.
    ahead = bits_where(s, [&](Doubles x, Doubles y, std::size_t) {
      const Doubles lx(light.at.x), ly(light.at.y), clear(light.margin * light.margin);
      const Doubles front = x * lx + y * ly - clear, dx = x - lx, dy = y - ly;
      return front > Doubles(0.0) && front * front > clear * (dx * dx + dy * dy);
    });
  }
  const unsigned low = past(light.low), high = past(light.high);
  const auto word = [](unsigned bits) { return static_cast<std::uint16_t>(bits); };
  return {word(low), word(high), word(low & before(light.low)), word(high & before(light.high)), word(ahead & all)};
}

}  // namespace

const SilhouetteTable& silhouette_table() {
  static constexpr SilhouetteTable table = {outline, mark};
  return table;
}

}  // namespace steradian::plane::STERADIAN_ISA
