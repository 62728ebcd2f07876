// Round lights by event lines: pairs of a light and a blocker, the squares among sixteen that a pair touches, and the light on a tile's
// pixels.
//
// The traversal of a frame is 256 -> 64 -> 16 pixels -> blocks of 4 x 4. Each step has sixteen children, which fit one register or a few,
// and a set of them is a word of 16 bits.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simd.h"
#include "plane/frame/tiles/tile.h"
#include "steradian/vector2.h"

namespace steradian::plane {

struct EventPair {
  enum class Kind : std::uint8_t {
    convex,
    round,
    lens,    // a disk whose outline crosses the light's; the general rule handles it
    general  // any other; the general rule handles it
  };
  // x, y, c in the order of EventLines: inner low and high, separator, outer low and high, chord. A lens occludes nothing in squares in
  // which all of the first three are below 0. A line that is never crossed is 0, 0, +-kNever.
  float lines[6][3];
  float radius;  // radius of a round blocker
  std::int32_t blocker;
  std::int32_t first;  // its vertices, or the centre of a round one, in FrameScene::vertices
  Kind kind;
  std::uint8_t count, end_first, ends, begin_first, begins;  // number of vertices; the chains, counter-clockwise from the first
};
inline constexpr double kNever = 1e30;

// Up to sixteen blockers of one kind, relative to the light's centre: one register of input from which lines are computed.
struct EventOutlines {
  static constexpr int kRoom = 16, kMostVertices = 8;
  alignas(64) float x[kMostVertices + 1][kRoom], y[kMostVertices + 1][kRoom];  // round: vertex 0 is the centre
  alignas(64) float radius[kRoom];
  EventPair* to[kRoom];
  int count = 0, most_vertices = 0;
};

// Sixteen squares, row by row, relative to a light.
struct EventSquares {
  const float *offset_x, *offset_y;  // their centres, relative to the first one's
  float x, y;                        // the first one's centre, relative to the light's
  float half_x, half_y;              // half a square, up to the centres of its outer pixels
  float slack;                       // largest error of a line by rounding
  float limit;                       // the sum of the light's radius and range
};

// Result of a node for one light: a list of pairs for each child.
struct EventLists {
  int* pairs[16];  // capacity for all of the node's pairs
  int sizes[16];
};

// A round light and a tile: places relative to the tile's centre.
struct EventLight {
  double tile_x, tile_y;  // the tile's centre, in the coordinates of the vertices
  float x, y, radius, inverse_range;
  float red, green, blue;
  float block;  // the side of a block
  EventSquares blocks;
  std::uint32_t open;     // the blocks that need light
  const Vec2d* vertices;  // vertices of the scene
  const EventPair* pairs;
};

// Work that remains for the general rule: the blocks, and the blockers that touch them.
struct EventRest {
  std::uint32_t blocks = 0;
  std::uint32_t taken = 0;  // number of pairs that touch any block in range
  bool lit = false;         // is any block in range of the light?
  bool shared = false;      // has anything been written to `shares`?
  std::vector<int> blockers;
  // Scratch memory.
  std::vector<std::uint64_t> items;
  std::vector<float> kept;
};

struct EventTable {
  void (*make_convex)(const EventOutlines& from, float radius);
  void (*make_round)(const EventOutlines& from, float radius);
  // Passes the pairs on to those of the wanted children that they touch. Returns the children in range that no blocker occludes alone.
  std::uint32_t (*split)(const EventPair* pairs, const int* list, int count, const EventSquares& children, std::uint32_t wanted,
                         EventLists& to);
  // `shares`: null, or the destination of each pixel's light before it is multiplied by the light's radiance.
  void (*add_light)(const EventLight& light, const int* list, int count, TileBuffer& tile, EventRest& rest, float* shares);
  // Adds such shares times a radiance.
  void (*add_shares)(const float* shares, float red, float green, float blue, TileBuffer& tile);
};

STERADIAN_DECLARE_PACK_TABLE(EventTable, event_table)

}  // namespace steradian::plane
