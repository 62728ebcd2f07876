// One tile of a frame and one emitter: the input of the packs' integration. Coordinates are floats relative to the tile's centre.
#pragma once

#include <cstddef>

#include "core/simd.h"

namespace steradian::plane {

inline constexpr int kTileSide = 16, kTilePixels = kTileSide * kTileSide;

struct TileItem {
  float px, py, qx, qy;             // chord, in any order
  float depth_x, depth_y, depth_c;  // the blocker is nearer if depth . (x, y, 1) > 0; only in deep items
};

// The end vertex of a blocker that reaches past the light on one side for all of the tile.
struct TileVertex {
  float x, y;
};

// A convex blocker in front of the light and of every pixel's axis. It covers the directions from the least of its first vertices to the
// greatest of its others.
struct TileSpan {
  int first, begins, ends;  // its vertices: index in TileLight::span_vertices, how many may begin and end it
};

// A convex blocker anywhere.
struct TileBody {
  TileSpan vertices;
  bool deep;  // nearer than the light only beyond its depth line
  float depth_x, depth_y, depth_c;
};

// A round blocker in front of the light and of every pixel's axis, or one that also reaches past the light on one side.
struct TileDisk {
  float x, y, radius;
};

struct TileRound {
  float cx, cy;          // ellipse: centre,
  float xx, xy, yx, yy;  // half axes x and y,
  float ux, uy, vx, vy;  // rows of the map to the unit circle
  float depth_x, depth_y, depth_c;
};

// A round blocker that overlaps the light.
struct TileLens {
  TileRound round;
  int count;
  struct Crossing {
    float x, y, lx, ly, bx, by;  // where the outlines cross, outward normals on the light and on the blocker
    bool begins;                 // Lens::Crossing
  } crossings[4];
};

// An arc of an ellipse: in its unit space, counter-clockwise from direction 0 over the middle one to direction 1.
struct TileArc {
  float x0, y0, x1, y1;          // its ends
  float u0, v0, u1, v1, um, vm;  // directions in unit space
  float least_cosine;            // least cosine of the angle between the middle and a place on the arc
  bool whole;                    // is it all of the ellipse?
  bool between_tangents;         // slopes are relative to the middle of the tangents, not to the centre
  float det;                     // determinant of the half axes
  float det_if_round;            // 0 if they differ
  int nodes;                     // number of nodes of Gauss' rule that serves all of the tile; 0: none does
  float ramp_x, ramp_y, ramp_c;  // radiance at p runs from `red` to `red_end` as dot(ramp, p - centre) + ramp_c does from 0 to 1, ...
};

// One edge of a run.
struct TilePart {
  float x, y;                          // a point of its line
  float nx, ny, begin, end;            // as of an edge
  float red, green, blue;              // at `begin` ...
  float red_end, green_end, blue_end;  // ... and at `end`, linear between
  float from_x, from_y, to_x, to_y;    // its ends
  bool small;                          // it faces all pixels, and none is nearer to it than five times its length
};

// Directions in which a spot's light arrives: counter-clockwise from low to high.
struct TileSpot {
  bool present, wide;  // wide: more than half a turn
  float low_x, low_y, high_x, high_y;
};

enum class TileKind { disk, edge, arc };

struct TileLight {
  TileKind kind;
  TileRound shape;  // disk, arc
  TileArc arc;
  TileSpot spot;
  // Disk: centre and radius. Edge: foot on its line, unit normal towards the lit side, ends as distances along. Run: the normal is opposite
  // to a direction in which all of it is ahead of every pixel.
  float x, y, radius;
  float nx, ny, begin, end;
  float inverse_range;                 // 0: no range
  float red, green, blue;              // a disk, a uniform edge, the start of an arc's ramp ...
  float red_end, green_end, blue_end;  // ... and its end
  int profile;                         // PlaneProfile as int
  bool linear;

  const TilePart* parts;  // edges, unless they emit the same in all directions and at all distances
  int part_count;
  bool all_parts_seen;            // none of them is occluded by others
  const TileVertex* low_corners;  // run: visible from the first of these
  int low_corner_count;
  const TileVertex* high_corners;  // up to the last of these
  int high_corner_count;
  const TileVertex* lows;  // ends of blockers that begin before the light
  int low_count;
  const TileVertex* highs;  // begins of blockers that end behind it
  int high_count;
  const TileDisk* low_disks;  // the same with disks
  int low_disk_count;
  const TileDisk* high_disks;
  int high_disk_count;
  const TileDisk* disks;
  int disk_count;
  const TileSpan* spans;
  int span_count;
  const TileBody* bodies;
  int body_count;
  const TileVertex* span_vertices;  // vertices of spans and bodies
  const TileItem* chords;           // any chord in front of the light
  int chord_count;
  const TileItem* deep;  // any chord, with a depth line
  int deep_count;
  const TileRound* rounds;
  int round_count;
  const TileLens* lenses;
  int lens_count;
  float* scratch;  // 32 floats for each interval that may be occluded
};

// The accumulators of a tile's pixels.
struct TileBuffer {
  static int slot(int x, int y) { return (y / 4 * 4 + x / 4) * 16 + (y % 4) * 4 + x % 4; }
  alignas(64) float x[kTilePixels], y[kTilePixels];  // pixel centres, in blocks of 4 x 4
  alignas(64) float red[kTilePixels], green[kTilePixels], blue[kTilePixels];
};

inline constexpr unsigned kAllBlocks = 0xffff;

struct TileTable {
  // Adds light on blocks of 4 x 4 pixels: a set of bits, in the buffer's order.
  void (*add_light)(const TileLight& light, TileBuffer& tile, unsigned blocks);
  // Writes the buffer's first columns and rows as pixels of red, green and blue; `stride` floats from row to row.
  void (*write)(const TileBuffer& tile, int width, int height, float* out, std::size_t stride);
};

STERADIAN_DECLARE_PACK_TABLE(TileTable, tile_table)

}  // namespace steradian::plane
