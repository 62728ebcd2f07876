// Sixteen lanes in packs, and helpers that the units of the lanes' table share.
#pragma once

#include "core/pack_bits.h"
#include "shadow/edges/segments.h"
#include "shadow/lanes/lanes.h"
#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA

using PackMask = PackKernels::mask;

// Calls use(i) for the first lane of each pack.
template <class Use>
STERADIAN_INLINE void each_pack(Use use) {
  for (std::size_t i = 0; i < shadow::kPoints; i += kLanes) use(i);
}
// Bits of the masks of(i).
template <class Of>
STERADIAN_INLINE std::uint32_t lane_bits(Of of) {
  std::uint32_t bits = 0;
  each_pack([&](std::size_t i) { bits |= bits_of(of(i)) << i; });
  return bits;
}

STERADIAN_INLINE PackReal get(const shadow::LaneReals& from, std::size_t i) { return load(from.at + i); }
STERADIAN_INLINE PackVec3 get(const shadow::LaneReals* from, std::size_t i) { return {get(from[0], i), get(from[1], i), get(from[2], i)}; }
STERADIAN_INLINE void put(shadow::LaneReals& to, std::size_t i, PackReal x) { store(to.at + i, x); }
STERADIAN_INLINE PackInt get(const shadow::LaneInts& from, std::size_t i) { return PackInt::load_unaligned(from.at + i); }
STERADIAN_INLINE void put(shadow::LaneInts& to, std::size_t i, PackInt x) { x.store_unaligned(to.at + i); }
STERADIAN_INLINE PackMask mask_at(std::uint32_t bits, std::size_t i) { return mask_of(bits >> i); }

STERADIAN_INLINE PackInt lower_of(const PackInt& a, const PackInt& b) { return select(a < b, a, b); }
STERADIAN_INLINE PackInt where(const PackMask& m, const PackInt& a) { return select(m, a, PackInt(0)); }

// Counts without the layers of a solid light, if there are any (without_layers).
STERADIAN_INLINE PackInt comparable(const PackInt& count, bool layered) {
  if (!layered) return count;
  const PackInt half(shadow::kLayer / 2);
  return select(count > half, PackInt(shadow::kHidden), ((count + half) & PackInt(shadow::kLayer - 1)) - half);
}

STERADIAN_INLINE shadow::LaneBits narrow(std::uint32_t bits) { return static_cast<shadow::LaneBits>(bits); }

// The least of a pack's numbers.
STERADIAN_INLINE float least_of(PackReal x) {
#if defined(__AVX512F__)
  return _mm512_reduce_min_ps(x.v);
#else
  alignas(64) float lanes[kLanes];
  store(lanes, x);
  float result = lanes[0];
  for (std::size_t i = 1; i < kLanes; ++i) result = lanes[i] < result ? lanes[i] : result;
  return result;
#endif
}

STERADIAN_INLINE std::uint32_t free_at(const shadow::SegmentLanes& s, int end) {
  return static_cast<std::uint32_t>(s.present) & ~static_cast<std::uint32_t>(end == 0 ? s.clipped_a : s.clipped_b);
}
STERADIAN_INLINE std::int32_t place_at(const shadow::SegmentLanes& s, int end) { return end == 0 ? s.place_a : s.place_b; }

// Least and largest of the values at(i) over the lanes of a mask.
template <class At>
STERADIAN_INLINE float least(std::uint32_t lanes, At at) {
  PackReal result(1e9);
  each_pack([&](std::size_t i) { result = min(result, select(mask_at(lanes, i), at(i), PackReal(1e9))); });
  return least_of(result);
}
template <class At>
STERADIAN_INLINE float largest(std::uint32_t lanes, At at) {
  return -least(lanes, [&](std::size_t i) { return -at(i); });
}

// Calls use(segment) for segments whose boxes may meet a range, from `first` on. It tests the boxes of blocks first, then those
// of their segments.
template <class Use>
STERADIAN_INLINE void near(const shadow::BoxArrays& b, std::size_t count, std::size_t first, float low_x, float high_x, float low_y,
                           float high_y, Use use) {
  constexpr std::size_t kBlock = shadow::kPadding;
  const PackReal lx = broadcast(low_x), hx = broadcast(high_x), ly = broadcast(low_y), hy = broadcast(high_y);
  const auto meets = [&](const float* lows_x, const float* highs_x, const float* lows_y, const float* highs_y, std::size_t at) {
    return lane_bits([&](std::size_t i) {
      return load(lows_y + at + i) <= hy && load(highs_y + at + i) >= ly && load(lows_x + at + i) <= hx && load(highs_x + at + i) >= lx;
    });
  };
  const auto from = [](std::size_t begin, std::size_t at) { return begin > at ? ~((1u << (begin - at)) - 1u) : ~0u; };
  const std::size_t blocks = shadow::padded(count) / kBlock;
  for (std::size_t group = first / kBlock / kBlock * kBlock; group < blocks; group += kBlock) {
    const std::uint32_t some = meets(b.block_low_x, b.block_high_x, b.block_low_y, b.block_high_y, group) & from(first / kBlock, group);
    for_each_bit(some, [&](std::size_t of) {
      const std::size_t at = (group + of) * kBlock;
      const std::uint32_t bits = meets(b.low_x, b.high_x, b.low_y, b.high_y, at) & from(first, at);
      for_each_bit(bits, [&](std::size_t lane) { use(static_cast<std::uint32_t>(at + lane)); });
    });
  }
}

// Floats hold differences of cells exactly; a product is off by 2^-24 of itself, and so is the difference of two.
STERADIAN_INLINE PackReal bound_of(PackReal p, PackReal q) { return PackReal(4e-7) * (abs(p) + abs(q)); }

shadow::SeenByLanes see_in_lanes(const shadow::LaneEdges& edges, const shadow::LaneView& view, std::uint16_t* front, std::int32_t* place_of,
                                 shadow::VertexLanes* vertices, shadow::SegmentLanes* to);
void bound_in_lanes(const shadow::SegmentLanes* segments, std::size_t count, const shadow::BoxArrays& boxes);
bool cross_in_lanes(shadow::LaneWork& work);
void count_in_lanes(shadow::LaneWork& work, const shadow::LaneView& view);
bool cut_in_lanes(shadow::LaneWork& work, shadow::LaneBits lanes, shadow::RegionLanes& result);

STERADIAN_END_ISA
