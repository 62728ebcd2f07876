// What stands in front of one light, as one tile sees it: blockers merged as far as all of the tile sees them overlap.
//
// A blocker that reaches past the light on one side takes away all up to its other end. What begins before that end is
// seen to begin before it, and moves the end on to its own; so shadows grow from both sides of the light, and where
// they meet the light is hidden from all of the tile. Whether a point is seen counter-clockwise of another is the sign
// of a function affine in the eye, so that the tile's corners answer for all of it.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/frame/silhouette.h"
#include "plane/frame/tile.h"

namespace steradian::plane {

struct DepthLine {
  float x = 0, y = 0, c = 0;  // the blocker is nearer where x px + y py + c > 0
};

class ShadowEnds {
 public:
  void enter(const TileArea& tile) { half_ = tile.half, radius_ = tile.radius; }
  // For another light. Silhouettes that are taken stay where they are in `pool`.
  void clear(const std::vector<Silhouette>& pool, Vec2d to_light);
  // A convex blocker in front of the light for all of the tile. Marks of the vertices that are ahead of all pixels;
  // whether it reaches past the light on either side.
  void take_front(int silhouette, std::uint8_t ahead, bool from_low, bool to_high);
  void take_deep(int silhouette, std::uint8_t ahead, const DepthLine& depth);
  void take(const TileRound& round, double bound) { far_rounds_.push_back({round, bound}); }
  void take(const TileLens& lens) { lenses_.push_back(lens); }
  bool hidden();                  // after the last of them: merges
  void write(TileLight& light);   // points into this object
  std::size_t intervals() const;  // most that may be taken from within the light

 private:
  struct Held {
    int silhouette;
    std::uint8_t ahead;
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
  std::vector<Vec2d> low_front_, high_front_;    // all that is before one of the first or after one of the others is taken
  std::vector<Vec2d> low_points_, high_points_;  // those of them that take it by themselves
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
