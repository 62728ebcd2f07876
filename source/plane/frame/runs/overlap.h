// Relation of a blocker to an emitter: apart, or overlapping in a way that directions decide.
//
// If two convex outlines overlap, the nearer one changes, from one direction to the next, only at a crossing of the two that is visible on
// both.
#pragma once

#include <vector>

#include "plane/frame/scene.h"

namespace steradian::plane {

inline constexpr double kTouching = 1e-9;  // smaller overlaps count as none

// Does a convex polygon, or a segment, come nearer to the emitter than a gap? A negative gap is an overlap.
bool comes_within(double gap, const Emitter& e, const Vec2d* vertices, std::size_t count);
inline bool overlaps(const Emitter& e, const Vec2d* vertices, std::size_t count) { return comes_within(-kTouching, e, vertices, count); }

struct Meeting {
  enum class Kind {
    apart,   // a line divides them
    cross,   // their outlines cross
    within,  // all of the blocker lies in the light
    hides,   // all of the emitter lies in the blocker
  };
  Kind kind = Kind::apart;
  DividingLine line;  // apart
  Lens lens;          // cross
};
// The relation of a round or elliptic blocker to an emitter.
Meeting meet(const Emitter& e, const Ellipse& blocker);

// The parts of a segment outside an ellipse.
struct SegmentParts {
  int count = 0;
  Vec2d from[2], to[2];
};
SegmentParts parts_outside(const Ellipse& ellipse, Vec2d p, Vec2d q);

// The ellipse of a disk or an arc.
Ellipse ellipse_of(const Emitter& e);

}  // namespace steradian::plane
