// A tile at the bottom of the recursion: its blockers turned into what the packs take.
#pragma once

#include <vector>

#include "plane/frame_scene.h"
#include "plane/tile.h"

namespace steradian {

struct TileArea {
  Vec2d center, half;  // a rectangle that holds the tile's pixel centres
  double radius;       // half its diagonal
};

class LeafBuilder {
 public:
  explicit LeafBuilder(const FrameScene& frame) : frame_(frame) {}

  // The emitter and those of `blockers` that may be in front of it; points into this object until the next call.
  // `visible` is false where one blocker hides the light from the whole tile.
  struct Result {
    TileLight light;
    bool visible;
  };
  Result build(const PlaneEmitter& emitter, const int* blockers, std::size_t count, const TileArea& tile);

 private:
  struct Depth {
    Vec2d normal;      // towards the blocker
    double offset = 0; // normal . p + offset > 0 on the blocker's side
  };
  enum class Side { front, behind, mixed };
  // Two lines that bound the hull of tile and emitter: normal . p > offset is outside.
  struct Hull {
    Vec2d low_normal, high_normal;  // low: the clockwise side of the light
    double low_offset = 0, high_offset = 0;
    bool beyond_low(Vec2d p) const { return dot(low_normal, p) > low_offset; }
    bool beyond_high(Vec2d p) const { return dot(high_normal, p) > high_offset; }
  };

  bool separate(const PlaneEmitter& e, const PlaneBlocker& b, Depth& depth) const;
  static float depth_at(const Depth& depth, const TileArea& tile);  // its constant about the tile's centre
  Side side_of(const Depth& depth, const TileArea& tile) const;
  void add_convex(const PlaneEmitter& e, const PlaneBlocker& b, const TileArea& tile);
  void add_silhouette(const PlaneEmitter& e, const PlaneBlocker& b, const int* faces, const Depth& depth, Side side, const TileArea& tile);
  void add_round(const PlaneEmitter& e, const PlaneBlocker& b, const TileArea& tile);
  static Hull hull_of(const PlaneEmitter& e, const TileArea& tile);
  bool ahead(const PlaneEmitter& e, Vec2d v, const TileArea& tile) const;
  bool merge_ends(const TileArea& tile);

  const FrameScene& frame_;
  Hull hull_;
  bool hidden_ = false;
  std::vector<TileVertex> lows_, highs_, span_vertices_;
  std::vector<TileSpan> spans_;
  std::vector<TileBody> bodies_;
  std::vector<TileItem> chords_, deep_;
  std::vector<TileRound> rounds_;
  std::vector<TileLens> lenses_;
  std::vector<float> scratch_;
};

}  // namespace steradian
