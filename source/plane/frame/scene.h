// What a frame needs of a scene: lights taken apart into emitters, bodies into convex blockers.
//
// An emitter is a disk or one side of a segment. Against a convex blocker that does not overlap it, a separating line
// says which is nearer, for all directions at once; a blocker that does overlap it is replaced, for this emitter only,
// by pieces that do not: the parts of its edges outside the emitter, or the lens rule for two disks.
#pragma once

#include <vector>

#include "plane/frame/cull.h"
#include "plane/frame/interior.h"
#include "plane/frame/silhouette.h"
#include "core/budget.h"
#include "plane/exact/world.h"

namespace steradian::plane {

struct Emitter {
  enum class Kind { disk, edge };
  Kind kind = Kind::disk;
  int body = 0;
  Vec2d a, b;             // an edge's ends, lit side to the right of a -> b; a disk's centre, twice
  double radius = 0;      // disk
  RadianceEnds radiance;  // of an edge; linear between

  Vec2d center;  // of a bounding circle
  double bound = 0;
  Vec2d normal;  // edge: unit, to the lit side
  double range = 0;
};

struct Blocker {
  enum class Kind { convex, ellipse, lens };
  Kind kind = Kind::convex;
  int body = 0;
  Vec2d center;  // of a bounding circle
  double bound = 0;
  std::size_t first = 0;  // convex: vertices, counter-clockwise; two for a segment
  std::size_t count = 0;
  int outline = -1;
  Vec2d x_axis, y_axis;     // ellipse, lens: half axes, cross(x, y) > 0
  bool round = false;       // ellipse: of equal half axes
  Vec2d crossing[2];        // lens: where the disks' outlines cross; beyond the first, seen counter-clockwise, the
  Vec2d light_normal[2];    // blocker is nearer, before the second; outward normals there of the light's disk
  Vec2d blocker_normal[2];  // and of the blocker
};

struct FrameScene {
  const World* world = nullptr;
  std::vector<Emitter> emitters;
  std::vector<char> general;  // by body: lights that only the general method serves
  bool any_general = false;
  std::vector<Blocker> blockers;  // of all bodies, then those that stand in for overlapping ones
  std::vector<Vec2d> vertices;
  std::vector<PaddedOutline> outlines;    // of convex blockers, by Blocker::outline
  BlockerList nearby;                     // emitter by emitter: blockers within its range, private ones too
  std::vector<std::size_t> first_nearby;  // by emitter, and one more
  std::vector<LightInterior> interior;    // by body, for lights
  std::vector<char> convex;               // by body: all of a row within it is one run
};

// Throws Error where the lights and what may block them are more than the budget allows.
FrameScene prepare_frame(const World& world, Budget& budget);

}  // namespace steradian::plane
