// A tile at the bottom of the recursion: its blockers turned into what the packs take.
#pragma once

#include <vector>

#include "plane/frame_scene.h"
#include "plane/tile.h"

namespace steradian {

struct TileArea {
  Vec2d center, half;  // a rectangle that holds the tile's pixel centres
};

class LeafBuilder {
 public:
  explicit LeafBuilder(const FrameScene& frame) : frame_(frame) {}

  // The emitter and those of `blockers` that may be in front of it; points into this object until the next call.
  TileLight build(const PlaneEmitter& emitter, const int* blockers, std::size_t count, const TileArea& tile);

 private:
  struct Depth {
    Vec2d normal;      // towards the blocker
    double offset = 0; // normal . p + offset > 0 on the blocker's side
  };
  enum class Side { front, behind, mixed };

  bool separate(const PlaneEmitter& e, const PlaneBlocker& b, Depth& depth) const;
  Side side_of(const Depth& depth, const TileArea& tile) const;
  void add_convex(const PlaneEmitter& e, const PlaneBlocker& b, const TileArea& tile);
  void add_round(const PlaneEmitter& e, const PlaneBlocker& b, const TileArea& tile);
  bool ahead(const PlaneEmitter& e, Vec2d v, const TileArea& tile) const;

  const FrameScene& frame_;
  std::vector<TileItem> ordered_, chords_, deep_;
  std::vector<TileRound> rounds_;
  std::vector<TileLens> lenses_;
  std::vector<float> scratch_;
};

}  // namespace steradian
