// Runs: edges of light that follow each other along an outline, as one emitter.
//
// From where every edge of a run faces, the run is seen once in every direction between its two ends, and so is its chord. What lies
// neither between chord and edges nor on them is in front of the one as it is in front of the other: blockers are looked at once
// for all of the edges, by the chord. Where the light is the same in all directions and at all distances, the chord's own integral is
// the run's; else every edge adds its own over what blockers leave.
#pragma once

#include <vector>

#include "plane/frame/scene.h"

namespace steradian::plane {

// The edges of a body's light in the order of its outline, with the runs that they make: a tree, each run before what it stands for.
// Runs turn by at most a sixth of a turn, and are taken apart in four at every level.
std::vector<Emitter> with_runs(const std::vector<Emitter>& emitters);

// Do all of its edges, and its chord, face all of the tile, some of them some of it, or none?
enum class Facing { none, some, all };
Facing facing(const Emitter* run, const TileArea& tile);

// Does an edge of the outline that is not of the run cross it, its chord, or what lies between?
bool crosses_run(const Emitter* run, Vec2d p, Vec2d q);

}  // namespace steradian::plane
