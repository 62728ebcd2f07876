// A tile at the bottom of the recursion: converts its blockers to the input of the packs.
#pragma once

#include <utility>
#include <vector>

#include "plane/frame/runs/runs.h"
#include "plane/frame/runs/shadow_ends.h"
#include "plane/frame/scene.h"
#include "plane/frame/tiles/tile.h"

namespace steradian::plane {

class LeafBuilder {
 public:
  explicit LeafBuilder(const FrameScene& frame) : frame_(frame), slots_(frame.blockers.size(), {0, 0}) {}

  // Selects the tile for the calls that follow.
  void enter(const TileRectangle& tile);

  // The emitter and those of `blockers` that may be in front of it; points into this object until the next call. `visible` is false if one
  // blocker, or several that follow each other, occlude the light from the whole tile.
  struct Result {
    TileLight light;
    bool visible;
  };
  Result build(const Emitter& emitter, const int* blockers, std::size_t count);

 private:
  // From here on places are relative to the tile's centre.
  struct Depth {
    Vec2d normal;       // towards the blocker
    double offset = 0;  // normal . p + offset > 0 on the blocker's side
    DepthLine line() const;
  };
  enum class Side { front, behind, mixed };
  struct Light {
    Vec2d a, b, center;
    double radius = 0, bound = 0;
    PlaneEllipse ellipse;     // disk, arc
    std::vector<Vec2d> hull;  // run
  };

  double extent(Vec2d normal) const;
  bool passes_by(Vec2d center, double radius) const;
  SeenEmitter see(const Emitter& e) const;
  int silhouette(int blocker);
  bool outline_of_many(const Blocker& b, Silhouette& s) const;
  Depth depth_of_round(const Blocker& b, Vec2d center) const;
  bool depth_of(int blocker, Depth& depth);
  Depth depth_of_run(int blocker);
  Side side_of(const Depth& depth) const;
  Side side_of_circle(Vec2d center, double radius) const;
  bool ahead(Vec2d v, double radius) const;
  void add_convex(int blocker);
  void add_round(int blocker);
  void add_lens(const Blocker& b);
  TileRound round_of(const PlaneEllipse& e) const;
  TileLight light_of(const Emitter& e) const;
  TileArc arc_of(const Emitter& e) const;
  void look_at_edges(const Emitter& run);
  void add_corners(const Emitter& run, TileLight& light);
  void add_parts(TileLight& light);

  const FrameScene& frame_;
  const SilhouetteTable& table_ = silhouette_table_for(active_simd());
  TileRectangle tile_;
  std::vector<Silhouette> pool_;  // for this tile: the first pool_count_
  std::size_t pool_count_ = 0;
  std::vector<std::pair<int, int>> slots_;  // by blocker: a tile's number, and the index in its pool
  int tile_number_ = 0;
  Light light_;
  SeenEmitter seen_;
  ShadowEnds shadows_;
  struct SeenEdge {
    const Emitter* edge;  // null for one of a hull
    Vec2d a, b;
    Facing facing;
  };
  std::vector<SeenEdge> edges_;  // edges of a run, or of the hull around it
  std::vector<TilePart> parts_;
  std::vector<TileVertex> low_corners_, high_corners_;
  std::vector<float> scratch_;
  // Lines between runs and blockers, which hold for every tile: the last one of each place.
  struct KnownLine {
    const Emitter* run = nullptr;
    int blocker = -1;
    DividingLine line;
  };
  std::vector<KnownLine> known_lines_;
  const Emitter* emitter_ = nullptr;
};

}  // namespace steradian::plane
