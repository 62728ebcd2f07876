// Runs: edges of light that follow each other along an outline and turn the same way, as one emitter.
//
// The edges of a run and the chord between its ends bound a convex region, its hull; a closed run is its own hull. A place that is apart
// from the hull sees of the run one interval of directions, whichever of its edges face it:
//   bulge    lit outside, and seen from the chord's lit side: from tangent to tangent. Nothing enters the hull but through its edges.
//   bowl     lit inside, and seen from the chord's lit side: what the chord shows. What enters the hull there leaves it through an edge.
//   closed   a convex outline, lit outside: from tangent to tangent.
//   hole     an outline that is lit inside: nothing. From within its hull its edges are seen one by one.
// What does not touch the hull is in front of all of the run or behind it, in the directions in which the two are seen: a line between the
// two says which. So blockers are looked at once for all of the edges. Where the light is the same in all directions and at all distances,
// the interval is all that counts; else every edge adds its own over what blockers leave.
#pragma once

#include <vector>

#include "plane/frame/convex.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

// The edges of a body's light in the order of its outline, with the runs that they make: a tree, each run before what it stands for.
// Runs that are not closed turn by at most a third of a turn; all are taken apart in four or so at every level.
std::vector<Emitter> with_runs(const World& world, const std::vector<Emitter>& emitters);

inline ConvexRegion region_of(const Emitter& run) { return {run.hull.data(), run.hull.size()}; }

// From where it points along, all of a run lies ahead of all of a tile, by at least so much; that is less than 0 where no direction will
// do.
struct RunView {
  Vec2d axis;  // unit
  double least;
};
RunView view_of(const Emitter& run, const TileArea& tile);

// How much of a line's lit side a tile sees: all of the tile, some of it, or none.
enum class Facing { none, some, all };
Facing facing(const Emitter& edge, const TileArea& tile);

// Is a run seen as one from all of the tile, from some of it, or is all of it unseen?
Facing seen_as_one(const Emitter* run, const TileArea& tile);

// Does an edge of the outline that is not of the run cross it, its chord, or what lies between?
bool crosses_run(const Emitter* run, Vec2d p, Vec2d q);

}  // namespace steradian::plane
