// Frame representation of a scene: emitters of its lights, and convex blockers of its bodies.
//
// An emitter is a disk, one side of a segment, a run of such sides, or an arc. If a convex blocker does not overlap it, a separating line
// says which is nearer, for all directions at once. A blocker that does overlap it is replaced, for this emitter only, by pieces that do
// not: the parts of its edges outside the emitter, or the lens rule for a round blocker.
#pragma once

#include <functional>
#include <vector>

#include "core/budget.h"
#include "plane/exact/world.h"
#include "plane/frame/events/events.h"
#include "plane/frame/runs/silhouette.h"
#include "plane/frame/tiles/cull.h"
#include "plane/frame/tiles/interior.h"

namespace steradian::plane {

struct Emitter {
  enum class Kind { disk, edge, arc };
  Kind kind = Kind::disk;
  int body = 0;
  Vec2d a, b;             // an edge's ends, lit side to the right of a -> b; a disk's or an ellipse's centre, twice
  double radius = 0;      // disk; arc: its ellipse, around its centre; run: how far from its chord a -> b, or its middle, it reaches
  RadianceEnds radiance;  // edge: linear between its ends. Arc: from a to b as dot(ramp, p - centre) + ramp_at_center goes from 0 to 1
  Vec2d ramp;
  double ramp_at_center = 0;
  PlaneEllipse ellipse;  // arc: counter-clockwise from tau0 over at most half a turn, or the whole outline
  double tau0 = 0, tau_span = 0;
  bool whole = false;
  bool wall = false;    // a wall that reflects light: uniform, whatever its body is
  bool hidden = false;  // all of it lies within a blocker: invisible from outside
  bool lid = false;     // an edge of the hull of a run `around` that is no edge of its outline, lit inwards by the radiance taken away
  // Run (runs.h): the number of emitters, itself and those that it represents, shorter runs and edges, which follow it; and the convex
  // region that it bounds.
  std::size_t group = 1;
  enum class RunShape { bulge, bowl, closed, around, hole };
  RunShape shape = RunShape::bulge;
  std::vector<Vec2d> hull;  // counter-clockwise; for a hole, a box around it
  std::size_t curve = 0;    // edge: index in World::curves

  Vec2d center;  // centre of a bounding circle
  double bound = 0;
  Vec2d normal;  // edge: unit, to the lit side
  double range = 0;
};

// Does it represent several edges of an outline, one after another?
inline bool is_run(const Emitter& e) { return e.group > 1; }

struct DividingLine {
  Vec2d normal;  // unit, towards the blocker
  Vec2d point;
};

// A blocker whose outline crosses a light's.
struct Lens {
  struct Crossing {
    Vec2d at, light_normal, blocker_normal;  // outward
    bool begins;                             // if it is visible on both, the blocker is nearer counter-clockwise beyond it; else before it
  };
  int count = 0;
  Crossing crossings[4];
};

struct Blocker {
  enum class Kind { convex, ellipse, lens };
  Kind kind = Kind::convex;
  int body = 0;
  Vec2d center;  // centre of a bounding circle
  double bound = 0;
  std::size_t first = 0;  // convex: vertices, counter-clockwise; two for a segment. Else its centre
  std::size_t count = 0;
  int outline = -1;  // convex: in FrameScene::outlines, if it has no more than PaddedOutline::kMost vertices
  // Chain: its edges, blockers too; they replace it where its hull is no blocker. Whole outline: its edges, and chains of them.
  int first_edge = -1, edges = 0, first_chain = -1, chains = 0;
  int level = 0;         // 0: it is part of no other; else one more than that of which it is a part
  Vec2d x_axis, y_axis;  // ellipse, lens: half axes, cross(x, y) > 0
  bool round = false;    // ellipse: are its half axes equal?
  int lens = -1;         // in FrameScene::lenses
  int line = -1;         // ellipse: in FrameScene::lines, if its bounding circle overlaps the emitter's
};

struct FrameScene {
  const World* world = nullptr;
  std::function<Vec3d(Vec2d)> light_at;  // its light by another way, for single pixels; empty: there is no such way
  std::vector<Emitter> emitters;
  std::vector<char> general;  // by body: lights that only the general method serves
  bool any_general = false;
  bool shines_within = true;      // are its lights visible from within?
  std::vector<Blocker> blockers;  // for all bodies, then the replacements of overlapping ones
  std::vector<Vec2d> vertices;
  std::vector<Lens> lenses;
  std::vector<DividingLine> lines;
  std::vector<PaddedOutline> outlines;    // convex blockers, by Blocker::outline
  BlockerList nearby;                     // emitter by emitter: blockers within its range, private ones too
  std::vector<std::size_t> first_nearby;  // by emitter, and one more: the index of its first blocker
  std::vector<std::size_t> nearby_count;  // number of its blockers; unused capacity may follow them
  std::vector<EventPair> pairs;           // pairs of disks; BlockerList::index refers to them
  double slack = 0;                       // largest error of a place by rounding to float
  std::vector<char> whole_run;            // by emitter: a run without anything between its edges and its chord
  std::vector<char> filled_run;           // by emitter: a whole run `around` without holes
  std::vector<LightInterior> interior;    // by body, for lights
  std::vector<char> convex;               // by body: each row within it is one interval
};

// Calls f with the index of each part of a blocker. The blocker may move while f runs.
template <class F>
void for_each_part(const std::vector<Blocker>& blockers, int blocker, F f) {
  const Blocker& b = blockers[static_cast<std::size_t>(blocker)];
  const int level = b.level + 1, first_chain = b.first_chain, chains = b.chains;
  for (int k = b.first_edge, end = k + b.edges; k < end; ++k)
    if (blockers[static_cast<std::size_t>(k)].level == level) f(k);
  for (int k = first_chain; k < first_chain + chains; ++k) f(k);
}

// The emission of an emitter's body.
const PlaneEmission& emission_of(const FrameScene& frame, const Emitter& e);

// Light sources of a frame: the scene's lights, and emitters of walls.
struct FrameLights {
  bool scene = true;
  std::vector<Emitter> walls;
  std::function<Vec3d(Vec2d)> walls_at;  // their light at a place, if it is known otherwise
};
// Throws Error if the lights and their possible blockers exceed the budget.
FrameScene prepare_frame(const World& world, Budget& budget, const FrameLights& lights = {});

}  // namespace steradian::plane
