// Round lights by event lines: pairs of a light and a blocker, which of sixteen squares a pair touches, and the light on a tile's pixels.
//
// The way down a frame is 256 -> 64 -> 16 pixels -> blocks of 4 x 4: sixteen children every time, which are one register or a few, and a
// set of them is a word of 16 bits.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simd.h"
#include "plane/frame/tile.h"
#include "steradian/vector2.h"

namespace steradian::plane {

struct EventPair {
  enum class Kind : std::uint8_t {
    convex,
    round,
    lens,    // a disk whose outline crosses the light's; the general rule takes it
    general  // any other; the general rule takes it
  };
  // x, y, c by rising number of EventLines: inner low and high, separator, outer low and high, chord. Of a lens nothing is taken where
  // all of the first three are below 0. A line that is never crossed is 0, 0, +-kNever.
  float lines[6][3];
  float radius;  // of a round blocker
  std::int32_t blocker;
  std::int32_t first;  // its vertices, or a round one's centre, in FrameScene::vertices
  Kind kind;
  std::uint8_t count, end_first, ends, begin_first, begins;  // all, and the chains, counter-clockwise from the first
};
inline constexpr double kNever = 1e30;

// Up to sixteen blockers of one kind, relative to the light's centre: a register's worth of what lines are made from.
struct EventOutlines {
  static constexpr int kRoom = 16, kMostVertices = 8;
  alignas(64) float x[kMostVertices + 1][kRoom], y[kMostVertices + 1][kRoom];  // round: the centre is vertex 0
  alignas(64) float radius[kRoom];
  EventPair* to[kRoom];
  int count = 0, most_vertices = 0;
};

// Sixteen squares, row by row, seen from a light.
struct EventSquares {
  const float *offset_x, *offset_y;  // their centres from the first one's
  float x, y;                        // the first one's, relative to the light's
  float half_x, half_y;              // half a square, to the centres of its outer pixels
  float slack;                       // what rounding may move a line by
  float limit;                       // the light's radius and range
};

// What a node hands on for one light: by child, a list of pairs.
struct EventLists {
  int* pairs[16];  // room for all of the node's pairs
  int sizes[16];
};

// A round light and a tile: places relative to the tile's centre.
struct EventLight {
  double tile_x, tile_y;  // the tile's centre, as vertices are given
  float x, y, radius, inverse_range;
  float red, green, blue;
  float block;  // the side of a block
  EventSquares blocks;
  std::uint32_t open;     // the blocks that want light
  const Vec2d* vertices;  // of the scene
  const EventPair* pairs;
};

// What the general rule is left to do: the blocks, and the blockers that touch them.
struct EventRest {
  std::uint32_t blocks = 0;
  std::uint32_t taken = 0;  // pairs that touch any block in range
  bool lit = false;         // is any block of it?
  bool shared = false;      // has anything gone into `shares`?
  std::vector<int> blockers;
  // Work room.
  std::vector<std::uint64_t> items;
  std::vector<float> kept;
};

struct EventTable {
  void (*make_convex)(const EventOutlines& from, float radius);
  void (*make_round)(const EventOutlines& from, float radius);
  // Hands the pairs on to those of the wanted children that they touch. Returns the children in range that no blocker hides alone.
  std::uint32_t (*split)(const EventPair* pairs, const int* list, int count, const EventSquares& children, std::uint32_t wanted,
                         EventLists& to);
  // `shares`: null, or where what the light sends to every pixel goes, before it is multiplied by its radiance.
  void (*add_light)(const EventLight& light, const int* list, int count, TileBuffer& tile, EventRest& rest, float* shares);
  // Adds such shares times a radiance.
  void (*add_shares)(const float* shares, float red, float green, float blue, TileBuffer& tile);
};

STERADIAN_DECLARE_PACK_TABLE(EventTable, event_table)

}  // namespace steradian::plane
