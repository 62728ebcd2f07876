// Runs: edges of light that follow each other along an outline and turn the same way, as one emitter.
//
// The edges of a run and the chord between its ends bound a convex region, its hull; a closed run is its own hull. From a place outside of
// the hull, one interval of directions of the run is visible, whichever of its edges face the place:
//   bulge    lit outside, and visible from the chord's lit side: from tangent to tangent. Nothing enters the hull except through its edges.
//   bowl     lit inside, and visible from the chord's lit side: through the chord. A ray that enters the hull there leaves by an edge.
//   closed   a convex outline, lit outside: from tangent to tangent.
//   around   a concave outline of even light, lit outside: from tangent to tangent. A ray that enters the hull between two of its vertices
//            meets the outline, since it leaves the hull elsewhere. From within its hull, if nothing else is there, the outline is
//            visible in all directions but those that leave the hull through a lid: an edge of the hull that is none of the outline.
//   hole     an outline that is lit inside: nothing. From within its hull its edges are visible one by one.
// A body that does not touch the hull is in front of all of the run or behind it, in the directions in which both are visible. A line
// between the two decides which. So blockers are tested once for all of the edges. If the light is the same in all directions and at all
// distances, only the interval counts. Otherwise every edge adds its own light over the interval that blockers leave.
#pragma once

#include <vector>

#include "plane/frame/runs/convex.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

// The edges of a body's light in the order of its outline, with the runs that they form: a tree, with each run before its parts. Runs that
// are not closed turn by at most a third of a turn. Every run is divided into four or so at every level.
std::vector<Emitter> with_runs(const World& world, const std::vector<Emitter>& emitters);

inline ConvexRegion region_of(const Emitter& run) { return {run.hull.data(), run.hull.size()}; }

// A direction along which all of a run lies ahead of all of a tile, by at least `least`; that is less than 0 if there is no such direction.
struct RunView {
  Vec2d axis;  // unit
  double least;
};
RunView view_of(const Emitter& run, const TileRectangle& tile);

// Visibility of a line's lit side: from all of the tile, from some of it, or from none.
enum class Facing { none, some, all };
Facing facing(Vec2d point, Vec2d normal, const TileRectangle& tile);
inline Facing facing(const Emitter& edge, const TileRectangle& tile) { return facing(edge.a, edge.normal, tile); }

// Is a run visible as one from all of the tile, from some of it, or is all of it invisible?
Facing seen_as_one(const Emitter* run, const TileRectangle& tile);

// Does all of the tile lie within the hull of a run `around`?
bool is_within_hull(const Emitter& run, const TileRectangle& tile);

// The number of lids, which follow a run `around`.
std::size_t count_lids(const Emitter* run);

// Does the point lie within the outline of a run that is the whole of it?
bool is_within_outline(const Emitter* run, Vec2d p);

// Does an edge of the outline outside the run cross the run, its chord, or the region between them?
bool crosses_run(const Emitter* run, Vec2d p, Vec2d q);

}  // namespace steradian::plane
