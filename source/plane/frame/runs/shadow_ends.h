// The blockers in front of one light, for one tile: merged if they overlap for all of the tile.
//
// A blocker that reaches past the light on one side occludes all up to its other end. A blocker that begins before that end moves the end
// on to its own. So shadows grow from both sides of the light. If they meet, the light is occluded from all of the tile. The test that a
// point is counter-clockwise of another is the sign of a function affine in the eye, so that the tile's corners decide it for all of the
// tile.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/frame/runs/silhouette.h"
#include "plane/frame/tiles/tile.h"

namespace steradian::plane {

struct DepthLine {
  float x = 0, y = 0, c = 0;  // the blocker is nearer where x px + y py + c > 0
};

class ShadowEnds {
 public:
  void enter(const TileRectangle& tile) { half_ = tile.half, radius_ = tile.radius; }
  // Begins another light. Silhouettes passed to `take` stay in `pool`.
  void clear(const std::vector<Silhouette>& pool, Vec2d to_light);
  // A convex blocker in front of the light for all of the tile. `ahead` marks the vertices that are ahead of all pixels; `from_low` and
  // `to_high` tell if it reaches past the light on either side.
  void take_front(int silhouette, std::uint16_t ahead, bool from_low, bool to_high);
  void take_deep(int silhouette, std::uint16_t ahead, const DepthLine& depth);
  void take(const TileRound& round, double bound) { far_rounds_.push_back({round, bound}); }
  void take(const TileLens& lens) { lenses_.push_back(lens); }
  bool hidden();                  // merges; call it after the last of them
  void write(TileLight& light);   // points into this object
  std::size_t intervals() const;  // largest number of intervals that may be occluded within the light

 private:
  struct Held {
    int silhouette;
    std::uint16_t ahead;
    bool deep, low_done = false, high_done = false, dropped = false;
    DepthLine depth = {};
  };
  struct Round {
    TileRound round;
    double bound;
  };
  const Silhouette& of(const Held& h) const { return (*pool_)[static_cast<std::size_t>(h.silhouette)]; }
  bool follows(Vec2d a, Vec2d b) const;
  bool follows_disk(Vec2d center, double radius, Vec2d b) const;
  void grow_low(Held& h);
  void grow_high(Held& h);
  bool covered(const Held& h) const;
  bool covered(Vec2d center, double radius) const;
  void drop_dominated();
  double turn_of(Vec2d v) const;

  Vec2d half_, axis_;
  double radius_ = 0;
  bool hidden_ = false;
  const std::vector<Silhouette>* pool_ = nullptr;
  std::vector<Held> held_;
  std::vector<Vec2d> low_front_, high_front_;    // everything before one of the first or after one of the others is occluded
  std::vector<Vec2d> low_points_, high_points_;  // the ends that occlude it by themselves
  std::vector<Round> far_rounds_;

  std::vector<TileVertex> lows_, highs_, vertices_;
  std::vector<TileDisk> low_disks_, high_disks_, disks_;
  std::vector<TileSpan> spans_;
  std::vector<TileBody> bodies_;
  std::vector<TileItem> chords_, deep_;
  std::vector<TileRound> rounds_;
  std::vector<TileLens> lenses_;
};

}  // namespace steradian::plane
