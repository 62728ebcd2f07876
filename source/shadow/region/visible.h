// The part of a light that a point sees: the visible level of the count, and the pieces that bound it. See steps 7 and 8 of
// docs/shadows.md.
#pragma once

#include <vector>

#include "shadow/region/arrangement.h"

namespace steradian::shadow {

// Occlusion test between two points. Implementations see exactly the triangles whose edges were gathered.
class Blockers {
 public:
  virtual ~Blockers() = default;
  // Returns true if anything lies between them, including near the ends.
  virtual bool between(Vec3d from, Vec3d to) const = 0;
};

// A piece of the boundary of the visible region, in cells of the light's box; the region lies on the left.
struct Boundary {
  double ax = 0, ay = 0, bx = 0, by = 0;
  Source source = Source::edge;
  std::uint32_t segment = 0;
};

struct VisibleRegion {
  std::vector<Boundary> boundary;  // empty: nothing is visible
  std::int32_t level = 0;          // the count that means unoccluded
  int rays = 0;
};

// Memory that one thread reuses.
struct Scratch {
  SegmentSet set;
  std::vector<Piece> pieces;
  SegmentArrays arrays;
  std::vector<std::int32_t> levels;
};

// Arranges scratch.set and finds the visible region. `from` is the point for which the set was built.
void find_visible(const LightFrame& frame, Vec3d from, const Blockers& blockers, Scratch& scratch, VisibleRegion& result);

// The same on packs.
void find_visible_on_packs(const ShadowTable& packs, const LightFrame& frame, Vec3d from, const Blockers& blockers, Scratch& scratch,
                           VisibleRegion& result);

// The width of a region, as a ray to a place in it can prove.
enum class Width { none, thin, wide };
// Judges the region of a level by its boundary among some pieces. x, y: a position inside it in cells, unless there is none.
Width width_of(const SegmentSet& set, const std::vector<Piece>& pieces, std::int32_t level, double& x, double& y);

// Ends of a boundary relative to the point, in world space.
struct WorldPiece {
  Vec3d a, b;
};
WorldPiece relative_to(Vec3d from, const LightFrame& frame, const Boundary& piece);

}  // namespace steradian::shadow
