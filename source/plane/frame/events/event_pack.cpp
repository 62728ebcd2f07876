// Event lines on packs: computed for sixteen blockers at once, and evaluated for sixteen squares at once.
#include "plane/frame/events/event_lines.h"

#include <algorithm>
#include <bit>

#include "core/pack_bits.h"
#include "plane/frame/events/event_cut.h"
#include "plane/frame/events/events.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

constexpr int kGroups = 16 / static_cast<int>(kLanes);

// Writes the lines lane by lane into the pairs.
STERADIAN_INLINE void write_lines(const EventLines<PackReal>& lines, const EventOutlines& from, int first) {
  alignas(64) float lane[6][3][kLanes], chain[4][kLanes];
  const EventLine<PackReal>* all[6] = {&lines.inner_low, &lines.inner_high, &lines.separator,
                                       &lines.outer_low, &lines.outer_high, &lines.chord};
  for (int e = 0; e < 6; ++e) store(lane[e][0], all[e]->x), store(lane[e][1], all[e]->y), store(lane[e][2], all[e]->c);
  store(chain[0], lines.end_first);
  store(chain[1], lines.end_last);
  store(chain[2], lines.begin_first);
  store(chain[3], lines.begin_last);
  for (int k = 0; k < static_cast<int>(kLanes) && first + k < from.count; ++k) {
    EventPair& pair = *from.to[first + k];
    for (int e = 0; e < 6; ++e)
      for (int i = 0; i < 3; ++i) pair.lines[e][i] = lane[e][i][k];
    const int vertices = pair.count;
    const auto length = [&](float a, float b) {
      const int n = static_cast<int>(b) - static_cast<int>(a);
      return static_cast<std::uint8_t>((n < 0 ? n + vertices : n) + 1);
    };
    pair.end_first = static_cast<std::uint8_t>(chain[0][k]);
    pair.ends = length(chain[0][k], chain[1][k]);
    pair.begin_first = static_cast<std::uint8_t>(chain[2][k]);
    pair.begins = length(chain[2][k], chain[3][k]);
  }
}

void make_convex(const EventOutlines& from, float radius) {
  for (int first = 0; first < from.count; first += static_cast<int>(kLanes)) {
    PackReal x[EventOutlines::kMostVertices + 1], y[EventOutlines::kMostVertices + 1];
    for (int k = 0; k <= from.most_vertices; ++k) x[k] = load(from.x[k] + first), y[k] = load(from.y[k] + first);
    write_lines(convex_event_lines(x, y, from.most_vertices, broadcast(radius)), from, first);
  }
}

void make_round(const EventOutlines& from, float radius) {
  for (int first = 0; first < from.count; first += static_cast<int>(kLanes))
    write_lines(round_event_lines(load(from.x[0] + first), load(from.y[0] + first), load(from.radius + first), broadcast(radius)), from,
                first);
}

// Positions of sixteen squares relative to lines.
class PackSquares {
 public:
  explicit STERADIAN_INLINE PackSquares(const EventSquares& s) : reach_(broadcast(std::max(s.half_x, s.half_y) + s.slack)) {
    for (int g = 0; g < kGroups; ++g) {
      x_[g] = load(s.offset_x + g * static_cast<int>(kLanes)) + broadcast(s.x);
      y_[g] = load(s.offset_y + g * static_cast<int>(kLanes)) + broadcast(s.y);
    }
  }
  STERADIAN_INLINE std::uint32_t in_range(const EventSquares& s) const {
    const PackReal limit = broadcast(s.limit), half_x = broadcast(s.half_x), half_y = broadcast(s.half_y);
    return each([&](int g) {
      const PackReal x = max(abs(x_[g]) - half_x, PackReal(0.0)), y = max(abs(y_[g]) - half_y, PackReal(0.0));
      return x * x + y * y < limit * limit;
    });
  }
  const PackReal* x() const { return x_; }
  const PackReal* y() const { return y_; }
  // The squares in which the pair may occlude some of the light.
  STERADIAN_INLINE std::uint32_t touched(const EventPair& pair) const {
    std::uint32_t untouched = 0;
    for (int g = 0; g < kGroups; ++g) {
      const PackMask a = below(pair.lines[0], g), b = below(pair.lines[1], g), c = below(pair.lines[2], g);
      untouched |= (pair.kind == EventPair::Kind::lens ? bits_of(a && b && c) : bits_of(a || b || c)) << (g * static_cast<int>(kLanes));
    }
    return ~untouched & 0xffff;
  }
  STERADIAN_INLINE std::uint32_t hidden(const EventPair& pair) const {
    return each([&](int g) { return above(pair.lines[3], g) && above(pair.lines[4], g) && above(pair.lines[5], g); });
  }
  // The squares in which the blocker occludes all from the low tangent, and all up to the high one.
  struct Sides {
    std::uint32_t low, high;
  };
  STERADIAN_INLINE Sides sides(const EventPair& pair) const {
    Sides sides{0, 0};
    for (int g = 0; g < kGroups; ++g) {
      const PackMask beyond = above(pair.lines[2], g) && above(pair.lines[5], g);
      sides.low |= bits_of(beyond && above(pair.lines[3], g)) << (g * static_cast<int>(kLanes));
      sides.high |= bits_of(beyond && above(pair.lines[4], g)) << (g * static_cast<int>(kLanes));
    }
    return sides;
  }

 private:
  STERADIAN_INLINE PackReal at(const float* line, int g) const {
    return broadcast(line[0]) * x_[g] + (broadcast(line[1]) * y_[g] - broadcast(line[2]));
  }
  STERADIAN_INLINE PackMask below(const float* line, int g) const { return at(line, g) < -reach_; }
  STERADIAN_INLINE PackMask above(const float* line, int g) const { return at(line, g) > reach_; }
  template <class F>
  STERADIAN_INLINE static std::uint32_t each(F f) {
    std::uint32_t bits = 0;
    for (int g = 0; g < kGroups; ++g) bits |= bits_of(f(g)) << (g * static_cast<int>(kLanes));
    return bits;
  }
  PackReal x_[kGroups], y_[kGroups], reach_;
};

constexpr int kAhead = 2;  // number of pairs that are fetched ahead

STERADIAN_INLINE void fetch(const EventPair* pairs, const int* list, int i, int count) {
  if (i + kAhead >= count) return;
  const char* pair = reinterpret_cast<const char*>(pairs + list[i + kAhead]);
  __builtin_prefetch(pair);
  __builtin_prefetch(pair + 64);
}

__attribute__((flatten)) std::uint32_t split(const EventPair* pairs, const int* list, int count, const EventSquares& children,
                                             std::uint32_t wanted, EventLists& to) {
  const PackSquares squares(children);
  wanted &= squares.in_range(children);
  for (int i = 0; i < count && wanted != 0; ++i) {
    fetch(pairs, list, i, count);
    const EventPair& pair = pairs[list[i]];
    std::uint32_t touched = squares.touched(pair) & wanted;
    if (touched == 0) continue;
    const std::uint32_t hidden = squares.hidden(pair);
    wanted &= ~hidden;
    for (touched &= ~hidden; touched != 0; touched &= touched - 1) {
      const int child = std::countr_zero(touched);
      to.pairs[child][to.sizes[child]++] = list[i];
    }
  }
  return wanted;
}

__attribute__((flatten)) void add_light(const EventLight& light, const int* list, int count, TileBuffer& tile, EventRest& rest,
                                        float* shares) {
  const PackSquares squares(light.blocks);
  std::uint32_t lit = light.open & squares.in_range(light.blocks), general = 0, within = 0;
  rest.taken = rest.blocks = 0;
  rest.lit = lit != 0;
  rest.shared = false;
  if (lit == 0) return;
  EventEnds ends(light, tile, shares);
  if (rest.items.size() < static_cast<std::size_t>(count)) rest.items.resize(static_cast<std::size_t>(2 * count));
  std::uint64_t* items = rest.items.data();
  std::uint64_t* last = items;
  // A blocker that occludes one end of the light is applied at once, also to blocks that may turn out to be occluded.
  for (int i = 0; i < count && lit != 0; ++i) {
    fetch(light.pairs, list, i, count);
    const EventPair& pair = light.pairs[list[i]];
    const std::uint32_t touched = squares.touched(pair) & lit;
    if (touched == 0) continue;
    ++rest.taken;
    if (pair.kind > EventPair::Kind::round) {
      general |= touched;
      *last++ = static_cast<std::uint64_t>(touched) << 32 | static_cast<std::uint32_t>(list[i]);
      continue;
    }
    const PackSquares::Sides sides = squares.sides(pair);
    lit &= ~(sides.low & sides.high);
    const std::uint32_t open = touched & lit, low = open & sides.low, high = open & sides.high, rest_of = open & ~(low | high);
    if (low != 0) ends.raise_low(pair, low);
    if (high != 0) ends.lower_high(pair, high);
    within |= rest_of;
    // The general rule, if a block needs it, takes all blockers that touch the block.
    if (open != 0)
      *last++ = static_cast<std::uint64_t>(rest_of) << 48 | static_cast<std::uint64_t>(open) << 32 | static_cast<std::uint32_t>(list[i]);
  }
  general &= lit;
  rest.blocks = general;
  rest.blockers.clear();
  if (general != 0)
    for (const std::uint64_t* item = items; item < last; ++item)
      if ((static_cast<std::uint32_t>(*item >> 32) & general & 0xffff) != 0)
        rest.blockers.push_back(light.pairs[static_cast<std::uint32_t>(*item)].blocker);
  lit &= ~general;
  if (lit == 0) return;
  // Only blockers that lie within the light in some block are visited again.
  std::uint64_t* kept = items;
  if ((within & lit) != 0)
    for (const std::uint64_t* item = items; item < last; ++item)
      if ((static_cast<std::uint32_t>(*item >> 48) & lit) != 0) *kept++ = *item;
  const std::size_t room = static_cast<std::size_t>(kept - items) * 2 * kLanes * 2;  // a lens-free body occludes one interval
  if (rest.kept.size() < room) rest.kept.resize(2 * room);
  ends.add_to(lit, within & lit, items, kept, rest.kept.data(), squares.x(), squares.y());
  rest.shared = ends.shared;
}

__attribute__((flatten)) void add_shares(const float* shares, float red, float green, float blue, TileBuffer& tile) {
  for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) add_share(i, load(shares + i), red, green, blue, tile);
}

}  // namespace

const EventTable& event_table() {
  static constexpr EventTable table = {make_convex, make_round, split, add_light, add_shares};
  return table;
}

}  // namespace steradian::plane::STERADIAN_ISA
