// Sixteen lanes in packs, and what the units of the lanes' table share.
#pragma once

#include "core/pack_bits.h"
#include "shadow/lanes.h"
#include "shadow/shadow_kernels.h"

STERADIAN_BEGIN_ISA

using ShadowPack = ShadowKernels<Pack>;
using PackMask = PackKernels::mask;

// use(i) for the first lane of each pack.
template <class Use>
STERADIAN_INLINE void each_pack(Use use) {
  for (std::size_t i = 0; i < shadow::kPoints; i += kLanes) use(i);
}
// The bits of masks of(i).
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

std::size_t see_in_lanes(const shadow::LaneEdges& edges, const shadow::LaneView& view, std::uint16_t* front, std::int32_t* place_of,
                         shadow::VertexLanes* vertices, std::size_t& vertex_count, shadow::SegmentLanes* to);
void bound_in_lanes(const shadow::SegmentLanes* segments, std::size_t count, const shadow::BoxArrays& boxes);
bool cross_in_lanes(shadow::LaneWork& work);
bool count_in_lanes(shadow::LaneWork& work, const shadow::LaneView& view);

STERADIAN_END_ISA
