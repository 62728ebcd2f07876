// Convex blockers as one tile sees them, and the positions of their vertices relative to a light. On packs of doubles: one vertex a lane.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd.h"
#include "steradian/plane.h"

namespace steradian::plane {

struct TileRectangle {
  Vec2d center, half;  // a rectangle that holds the tile's pixel centres
  double radius;       // half its diagonal
};

// A convex polygon or a segment, counter-clockwise; the first vertex repeats beyond the last.
struct PaddedOutline {
  static constexpr int kMost = 8;
  double x[kMost + 1], y[kMost + 1];
  int count;
};

// Data that is the same for all lights. Places are relative to the tile's centre; sets of vertices are bits.
struct Silhouette {
  static constexpr int kMost = 16;
  enum class Kind : std::uint8_t { polygon, segment, disk };
  alignas(64) double x[kMost], y[kMost];  // as in the outline; if it has more than eight, those in which it may begin or end
  Vec2d center;                           // centre of a bounding circle, a disk's own; its vertices are a diameter's ends
  double radius;
  std::uint8_t count;
  std::uint16_t begins, ends;  // vertices in which some pixel may see it begin and end, counter-clockwise
  Kind kind;
  bool outside;  // is all of the tile outside?
  Vec2d at(int k) const { return {x[k], y[k]}; }
};

// A line past a light and its tile, and the places on it beside the tile and beside the light. A point beyond the line and between the two
// is seen, from all of the tile, beside the light.
struct HullSide {
  Vec2d normal, forward;
  double offset = 0, limit = 0;
  double least = -1e300;  // edges: a point ahead of them may lie behind the tile. For a disk it cannot
};

struct SeenEmitter {
  bool edge = false;
  Vec2d normal;        // edge: normal to the lit side
  Vec2d at;            // disk: centre
  double margin = 0;   // the tile's reach along the normal; its radius for a disk
  HullSide low, high;  // low: the clockwise side
};

// Sets of vertices: past the lines, beside the light, and in front of every pixel's axis.
struct VertexMarks {
  std::uint16_t past_low, past_high, beside_low, beside_high, ahead;
};

struct SilhouetteTable {
  // Computes vertices, count, begins and ends.
  void (*outline)(const PaddedOutline& from, const TileRectangle& tile, Silhouette& s);
  VertexMarks (*mark)(const Silhouette& s, const SeenEmitter& light);
};

STERADIAN_DECLARE_PACK_TABLE(SilhouetteTable, silhouette_table)

}  // namespace steradian::plane
