// The part of a round light that blockers leave visible, for each block of 4 x 4 pixels, and its light. For *_pack.cpp only.
//
// A ray is identified by the signed distance at which it passes the light's centre (plane_place_on_light): from -radius to radius.
#pragma once

#include <algorithm>
#include <bit>

#include "plane/frame/events/event_lines.h"
#include "plane/frame/events/events.h"
#include "plane/frame/tiles/disk_share.h"
#include "plane/frame/tiles/tile_cut.h"

namespace steradian::plane::STERADIAN_ISA {
namespace {

// The result is the same to the last bit, whether the share has just been computed or was cached.
STERADIAN_INLINE void add_share(int i, PackReal share, float red, float green, float blue, TileBuffer& tile) {
  const auto add = [&](float* p, float radiance) { store(p + i, PackReal::of(xsimd::fma(share.v, broadcast(radiance).v, load(p + i).v))); };
  add(tile.red, red);
  add(tile.green, green);
  add(tile.blue, blue);
}

class EventEnds {
 public:
  bool shared = false;  // has anything been written to `shares`?
  EventEnds(const EventLight& light, TileBuffer& tile, float* shares) : light_(light), tile_(tile), shares_(shares) {
    const PackReal radius = broadcast(light.radius);
    for (int i = 0; i < kTilePixels; i += static_cast<int>(kLanes)) {
      store(low_ + i, -radius);
      store(high_ + i, radius);
    }
  }

  STERADIAN_INLINE void raise_low(const EventPair& pair, std::uint32_t blocks) {
    if (pair.kind == EventPair::Kind::round)
      return on_blocks(blocks, [&](int i) {
        const auto round = round_ends(pair, light_, load(tile_.x + i), load(tile_.y + i));
        store(low_ + i, max(load(low_ + i), round.end));
      });
    for (int k = 0; k < pair.ends; ++k) {
      const Vertex v(light_, pair, pair.end_first + k);
      on_blocks(blocks, [&](int i) { store(low_ + i, max(load(low_ + i), v.place(load(tile_.x + i), load(tile_.y + i)))); });
    }
  }

  STERADIAN_INLINE void lower_high(const EventPair& pair, std::uint32_t blocks) {
    if (pair.kind == EventPair::Kind::round)
      return on_blocks(blocks, [&](int i) {
        const auto round = round_ends(pair, light_, load(tile_.x + i), load(tile_.y + i));
        store(high_ + i, min(load(high_ + i), round.begin));
      });
    for (int k = 0; k < pair.begins; ++k) {
      const Vertex v(light_, pair, pair.begin_first + k);
      on_blocks(blocks, [&](int i) { store(high_ + i, min(load(high_ + i), v.place(load(tile_.x + i), load(tile_.y + i)))); });
    }
  }

  // Adds the light on the blocks; `within` are those in which one of the items may lie within the light. An item is a set of blocks in its
  // upper 16 bits and a pair in its lower 32. The blocks' centres are relative to the light's.
  STERADIAN_INLINE void add_to(std::uint32_t blocks, std::uint32_t within, const std::uint64_t* items, const std::uint64_t* last,
                               float* kept, const PackReal* block_x, const PackReal* block_y) {
    if (light_.inverse_range > 0.0f) {
      const DiskQuadratics far(light_, block_x, block_y);
      add_with(blocks & far.blocks, within, items, last, kept, far);
      add_with(blocks & ~far.blocks, within, items, last, kept, DiskWindow(light_));
    } else {
      add_with(blocks, within, items, last, kept, DiskAngle(light_));
    }
  }

 private:
  struct Vertex {
    PackReal x, y, from_x, from_y;  // relative to the tile's centre, and to the light's centre
    STERADIAN_INLINE Vertex(const EventLight& light, const EventPair& pair, int k) {
      if (k >= pair.count) k -= pair.count;
      const Vec2d v = light.vertices[pair.first + k];
      const float at_x = static_cast<float>(v.x - light.tile_x), at_y = static_cast<float>(v.y - light.tile_y);
      x = broadcast(at_x);
      y = broadcast(at_y);
      from_x = broadcast(at_x - light.x);
      from_y = broadcast(at_y - light.y);
    }
    STERADIAN_INLINE PackReal place(PackReal px, PackReal py) const {
      return PackKernels().plane_place_on_light({from_x, from_y}, {x - px, y - py});
    }
  };

  STERADIAN_INLINE static PackKernels::PlaneRoundEnds round_ends(const EventPair& pair, const EventLight& light, PackReal px, PackReal py) {
    const Vertex center(light, pair, 0);
    return PackKernels().plane_round_ends({broadcast(light.x) - px, broadcast(light.y) - py}, {center.x - px, center.y - py},
                                          {center.from_x, center.from_y}, broadcast(pair.radius));
  }

  template <class F>
  STERADIAN_INLINE static void on_blocks(std::uint32_t blocks, F f) {
    for (; blocks != 0; blocks &= blocks - 1) {
      const int first = std::countr_zero(blocks) * 16;
      for (int i = first; i < first + 16; i += static_cast<int>(kLanes)) f(i);
    }
  }

  STERADIAN_INLINE void take(const EventPair& pair, PackReal px, PackReal py, Cut& cut) const {
    const float* line = pair.lines[2];
    const PackReal nx = broadcast(line[0]), ny = broadcast(line[1]), c = broadcast(line[2]);
    const PackReal x = px - broadcast(light_.x), y = py - broadcast(light_.y);
    const PackMask nearer = x * nx + (y * ny - c) > PackReal(0.0);
    if (!any_lane(nearer)) return;
    if (pair.kind == EventPair::Kind::round) {
      const auto round = round_ends(pair, light_, px, py);
      // An end behind the pixel is on the other's far side. All of the blocker may be behind, if the separator is short of it.
      const PackReal from = select(round.begins_ahead, round.begin, PackReal(-1e6)),
                     to = select(round.ends_ahead, round.end, PackReal(1e6));
      cut.take(from, to, nearer && (round.begins_ahead || round.ends_ahead) && from < to);
      return;
    }
    // A vertex behind the pixel is beyond all of the light, on that side of the blocker's nearest point, which is ahead.
    const float scale = line[2] / (line[0] * line[0] + line[1] * line[1]);
    const PackReal near_x = broadcast(line[0] * scale) - x, near_y = broadcast(line[1] * scale) - y;
    PackReal from(1e6), to(-1e6);
    for (int k = 0; k < pair.count; ++k) {
      const Vertex v(light_, pair, k);
      const PackReal wx = v.x - px, wy = v.y - py;
      const PackReal across = v.from_y * wx - v.from_x * wy, ahead = -(x * wx + y * wy);
      PackReal place = across * inversesqrt(max(wx * wx + wy * wy, PackReal(1e-30)));
      const PackMask behind = ahead <= PackReal(0.0);
      if (any_lane(behind)) {
        const PackMask beyond = near_x * wy - near_y * wx > PackReal(0.0);
        place = select(behind, select(beyond, PackReal(1e6), PackReal(-1e6)), place);
      }
      from = min(from, place);
      to = max(to, place);
    }
    cut.take(from, to, nearer && from < to);
  }

  template <class Share>
  STERADIAN_INLINE void add_with(std::uint32_t blocks, std::uint32_t within, const std::uint64_t* items, const std::uint64_t* last,
                                 float* kept, const Share& share) {
    for (; blocks != 0; blocks &= blocks - 1) {
      const int block = std::countr_zero(blocks);
      for (int i = block * 16; i < block * 16 + 16; i += static_cast<int>(kLanes)) {
        const PackReal px = load(tile_.x + i), py = load(tile_.y + i);
        const auto seen = share.at(block, px, py);
        Cut cut;
        cut.low = clamp(load(low_ + i), -seen.reach, seen.reach);
        cut.high = max(min(load(high_ + i), seen.reach), cut.low);
        if (cut.dark()) continue;
        PackReal sum;
        if ((within >> block & 1) != 0) {
          cut.kept = kept;
          for (const std::uint64_t* item = items; item < last; ++item)
            if ((*item >> (48 + block) & 1) != 0) take(light_.pairs[static_cast<std::uint32_t>(*item)], px, py, cut);
          if (cut.dark()) continue;
          sum = PackReal(0.0);
          cut.for_each_gap([&](PackReal from, PackReal to) { sum += seen.between(from, to); });
        } else {
          sum = seen.is_whole(cut.low, cut.high) ? seen.whole() : seen.between(cut.low, cut.high);
        }
        add_colour(i, max(sum, PackReal(0.0)));
      }
    }
  }

  STERADIAN_INLINE void add_colour(int i, PackReal share) {
    share = share * PackKernels().inverse_two_pi();
    if (shares_ != nullptr) {
      if (!shared) std::fill_n(shares_, kTilePixels, 0.0f);
      shared = true;
      store(shares_ + i, share);
    }
    add_share(i, share, light_.red, light_.green, light_.blue, tile_);
  }

  const EventLight& light_;
  TileBuffer& tile_;
  float* shares_;
  alignas(64) float low_[kTilePixels];
  alignas(64) float high_[kTilePixels];
};

}  // namespace
}  // namespace steradian::plane::STERADIAN_ISA
