// What a frame needs of a scene: lights taken apart into emitters, bodies into convex blockers.
//
// An emitter is a disk, one side of a segment, a run of such sides, or an arc. Against a convex blocker that does not overlap it, a
// separating line says which is nearer, for all directions at once; a blocker that does overlap it is replaced, for this emitter only, by
// pieces that do not: the parts of its edges outside the emitter, or the lens rule for what is round.
#pragma once

#include <functional>
#include <vector>

#include "plane/frame/cull.h"
#include "plane/frame/events.h"
#include "plane/frame/interior.h"
#include "plane/frame/silhouette.h"
#include "core/budget.h"
#include "plane/exact/world.h"

namespace steradian::plane {

struct Emitter {
  enum class Kind { disk, edge, arc };
  Kind kind = Kind::disk;
  int body = 0;
  Vec2d a, b;             // an edge's ends, lit side to the right of a -> b; a disk's or an ellipse's centre, twice
  double radius = 0;      // disk; of an arc's ellipse, about its centre; of a run, how far from its chord a -> b, or its middle, it reaches
  RadianceEnds radiance;  // of an edge; linear between. Of an arc: a + b dot(ramp, p - centre)
  Vec2d ramp;
  Ellipse ellipse;  // arc: counter-clockwise from tau0 over at most half a turn, or the whole outline
  double tau0 = 0, tau_span = 0;
  bool whole = false;
  bool wall = false;    // sends on what arrives: uniform, whatever its body is
  bool hidden = false;  // all of it lies within a blocker: not seen from outside
  // Of a run (runs.h): with the emitters that it stands for, shorter runs and edges, which follow it; and the convex region that it bounds.
  std::size_t group = 1;
  enum class RunShape { bulge, bowl, closed, hole };
  RunShape shape = RunShape::bulge;
  std::vector<Vec2d> hull;  // counter-clockwise; of a hole, about it
  std::size_t curve = 0;    // of an edge: in World::curves

  Vec2d center;  // of a bounding circle
  double bound = 0;
  Vec2d normal;  // edge: unit, to the lit side
  double range = 0;
};

// Does it stand for several edges of an outline, one after another?
inline bool is_run(const Emitter& e) { return e.group > 1; }

struct DividingLine {
  Vec2d normal;  // unit, towards the blocker
  Vec2d point;
};

// A blocker whose outline crosses a light's.
struct Lens {
  struct Crossing {
    Vec2d at, light_normal, blocker_normal;  // outward
    bool begins;                             // where it is seen on both, the blocker is nearer counter-clockwise beyond it; else before it
  };
  int count = 0;
  Crossing crossings[4];
};

struct Blocker {
  enum class Kind { convex, ellipse, lens };
  Kind kind = Kind::convex;
  int body = 0;
  Vec2d center;  // of a bounding circle
  double bound = 0;
  std::size_t first = 0;  // convex: vertices, counter-clockwise; two for a segment. Else its centre
  std::size_t count = 0;
  int outline = -1;
  int first_edge = -1, edges = 0;  // of a chain: its edges, blockers too; they stand for it where its hull is no blocker
  bool in_chain = false;           // such an edge
  Vec2d x_axis, y_axis;            // ellipse, lens: half axes, cross(x, y) > 0
  bool round = false;              // ellipse: of equal half axes
  int lens = -1;                   // in FrameScene::lenses
  int line = -1;                   // ellipse: in FrameScene::lines, where its bounding circle overlaps the emitter's
};

struct FrameScene {
  const World* world = nullptr;
  std::function<Vec3d(Vec2d)> light_at;  // its light by another way, for single pixels; none: there is no such way
  std::vector<Emitter> emitters;
  std::vector<char> general;  // by body: lights that only the general method serves
  bool any_general = false;
  bool shines_within = true;      // its lights are seen from within
  std::vector<Blocker> blockers;  // of all bodies, then those that stand in for overlapping ones
  std::vector<Vec2d> vertices;
  std::vector<Lens> lenses;
  std::vector<DividingLine> lines;
  std::vector<PaddedOutline> outlines;    // of convex blockers, by Blocker::outline
  BlockerList nearby;                     // emitter by emitter: blockers within its range, private ones too
  std::vector<std::size_t> first_nearby;  // by emitter, and one more: where its blockers begin,
  std::vector<std::size_t> nearby_count;  // and how many there are; what follows them may be room
  std::vector<EventPair> pairs;           // of disks; BlockerList::index is among these for them
  double slack = 0;                       // what rounding to float may move a place by
  std::vector<char> whole_run;            // by emitter: a run of which nothing else comes between edges and chord
  std::vector<LightInterior> interior;    // by body, for lights
  std::vector<char> convex;               // by body: all of a row within it is one run
};

// What an emitter's body says of its light.
const PlaneEmission& emission_of(const FrameScene& frame, const Emitter& e);

// What shines in a frame: the scene's lights, and emitters of walls.
struct FrameLights {
  bool scene = true;
  std::vector<Emitter> walls;
  std::function<Vec3d(Vec2d)> walls_at;  // their light at a place, if it is known otherwise
};
// Throws Error where the lights and what may block them are more than the budget allows.
FrameScene prepare_frame(const World& world, Budget& budget, const FrameLights& lights = {});

}  // namespace steradian::plane
