// The lowest level and its boundary, for sixteen points at once.
#include <climits>

#include "shadow/edges/segments.h"
#include "shadow/lanes/lanes_pack.h"

STERADIAN_BEGIN_ISA
namespace {

using namespace shadow;

// The counts of a segment's two sides.
struct SideCounts {
  PackInt left, right;

  STERADIAN_INLINE SideCounts(const PackInt& on_left, const PackInt& weight, bool layered)
      : left(comparable(on_left, layered)), right(comparable(on_left - weight, layered)) {}
  STERADIAN_INLINE PackInt lower() const { return lower_of(left, right); }
  STERADIAN_INLINE PackInt higher() const { return select(left < right, right, left); }
  // Bits of the lanes where a piece lies between the level and higher counts.
  STERADIAN_INLINE std::uint32_t bound(const PackInt& level) const { return bits_of(!(lower() > level)) & bits_of(higher() > level); }
};

// Lanes where a segment is one piece.
STERADIAN_INLINE std::uint32_t whole_in(const SegmentLanes& s) {
  const std::uint32_t length =
      lane_bits([&](std::size_t i) { return abs(get(s.bx, i) - get(s.ax, i)) + abs(get(s.by, i) - get(s.ay, i)) > PackReal(0.0); });
  return static_cast<std::uint32_t>(s.present) & ~static_cast<std::uint32_t>(s.crossed) & length;
}
STERADIAN_INLINE std::uint32_t cut_in(const SegmentLanes& s) {
  return static_cast<std::uint32_t>(s.crossed) & static_cast<std::uint32_t>(s.present);
}

// Calls use(i, from, to, left) for the stretches between crossings, pack by pack; left is the count on their left where to > from.
template <class Use>
STERADIAN_INLINE void each_stretch(const LaneWork& work, std::size_t number, Use use) {
  const SegmentLanes& e = work.segments[number];
  const std::size_t last = work.crossing_first[number + 1];
  const PackReal one(1.0);
  LaneReals reached{};
  LaneInts left = e.left;
  for (std::size_t k = work.crossing_first[number]; k <= last; ++k)
    each_pack([&](std::size_t i) {
      const PackReal from = get(reached, i), to = k < last ? min(get(work.sorted_t[k], i), one) : one;
      use(i, from, to, get(left, i));
      put(reached, i, max(from, to));
      if (k < last) put(left, i, get(left, i) + get(work.sorted_change[k], i));
    });
}

// Finds the lowest levels above the floors.
void find_levels(const LaneWork& work, const LaneInts& floor, LaneInts& level) {
  const PackInt none(INT_MAX);
  each_pack([&](std::size_t i) { put(level, i, none); });
  const auto low_of = [&](const PackInt& left, const PackInt& weight, std::size_t i) {
    const PackInt low = SideCounts(left, weight, work.layered).lower();
    return select(low > get(floor, i), low, none);
  };
  for (std::size_t s = 0; s < work.count; ++s) {
    SegmentLanes& e = work.segments[s];
    e.bounds = narrow(whole_in(e));
    each_pack([&](std::size_t i) { put(e.low, i, select(mask_at(e.bounds, i), low_of(get(e.left, i), get(e.weight, i), i), none)); });
    const std::uint32_t crossed = cut_in(e);
    if (crossed != 0)
      each_stretch(work, s, [&](std::size_t i, const PackReal& from, const PackReal& to, const PackInt& left) {
        const PackInt low = low_of(left, get(e.weight, i), i);
        put(e.low, i, select(to > from && mask_at(crossed, i), lower_of(get(e.low, i), low), get(e.low, i)));
      });
    each_pack([&](std::size_t i) {
      const PackInt low = get(e.low, i);
      put(level, i, lower_of(get(level, i), select(low < PackInt(kHidden / 2), low, none)));
    });
  }
}

// Adds the pieces of a segment that bound the level, in some lanes; returns false if the capacity is too small.
bool cut(LaneWork& work, std::uint32_t number, std::uint32_t lanes, const LaneInts& level) {
  const SegmentLanes& e = work.segments[number];
  const std::size_t most = kPoints * (work.crossing_first[number + 1] - work.crossing_first[number] + 1);
  if (work.pieces.size + most > work.pieces.capacity) return false;
  LaneReals x = e.ax, y = e.ay;
  each_stretch(work, number, [&](std::size_t i, const PackReal& from, const PackReal& to, const PackInt& left) {
    const PackMask longer = to > from, inner = to < PackReal(1.0);
    const PackReal ax = get(e.ax, i), ay = get(e.ay, i), bx = get(e.bx, i), by = get(e.by, i);
    const PackReal next_x = select(inner, ax + to * (bx - ax), bx), next_y = select(inner, ay + to * (by - ay), by);
    const std::uint32_t bounds = bits_of(longer) & SideCounts(left, get(e.weight, i), work.layered).bound(get(level, i)) & (lanes >> i);
    if (bounds != 0) {
      LaneReals to_x, to_y;
      put(to_x, i, next_x);
      put(to_y, i, next_y);
      for_each_bit(bounds, [&](std::size_t k) {
        const std::size_t lane = i + k;
        CrossedPiece& p = work.pieces.data[work.pieces.size++];
        const bool backwards = e.weight.at[lane] > 0;  // the right side has the lower count
        p = {x.at[lane], y.at[lane], to_x.at[lane], to_y.at[lane], number, static_cast<std::uint16_t>(lane)};
        if (backwards) p = {p.bx, p.by, p.ax, p.ay, p.segment, p.lane};
      });
    }
    put(x, i, select(longer, next_x, get(x, i)));
    put(y, i, select(longer, next_y, get(y, i)));
  });
  return true;
}

}  // namespace

__attribute__((flatten)) bool cut_in_lanes(LaneWork& work, LaneBits lanes, RegionLanes& result) {
  find_levels(work, result.floor, result.level);
  result.none = narrow(lanes & lane_bits([&](std::size_t i) { return get(result.level, i) == PackInt(INT_MAX); }));
  // Below the lowest level there is no piece. Above a floor, all crossed segments may have pieces that bound the level.
  const std::uint32_t floored = lane_bits([&](std::size_t i) { return get(result.floor, i) > PackInt(INT_MIN); });
  work.pieces.size = 0;
  for (std::uint32_t s = 0; s < work.count; ++s) {
    SegmentLanes& e = work.segments[s];
    std::uint32_t bounds = 0, at_level = floored;
    each_pack([&](std::size_t i) {
      bounds |= SideCounts(get(e.left, i), get(e.weight, i), work.layered).bound(get(result.level, i)) << i;
      at_level |= bits_of(get(e.low, i) == get(result.level, i)) << i;
    });
    e.bounds = narrow(e.bounds & bounds & ~static_cast<std::uint32_t>(result.none));
    const std::uint32_t crossed = cut_in(e) & at_level & ~static_cast<std::uint32_t>(result.none);
    if (crossed != 0 && !cut(work, s, crossed, result.level)) return false;
  }
  return true;
}

STERADIAN_END_ISA
