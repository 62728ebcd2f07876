// Relations of a blocker to an emitter: apart, overlapping, or occluding it from all of a tile.
#pragma once

#include <cmath>
#include <vector>

#include "plane/frame/runs/silhouette.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

// Relation of a blocker to an emitter: apart, or overlapping in a way that directions decide.
//
// If two convex outlines overlap, the nearer one changes, from one direction to the next, only at a crossing of the two that is visible on
// both.

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
Meeting meet(const Emitter& e, const PlaneEllipse& blocker);

// The parts of a segment outside an ellipse.
struct SegmentParts {
  int count = 0;
  Vec2d from[2], to[2];
};
SegmentParts parts_outside(const PlaneEllipse& ellipse, Vec2d p, Vec2d q);

// The ellipse of a disk or an arc.
PlaneEllipse ellipse_of(const Emitter& e);

// Tests that an emitter is invisible from all of a tile, by its own shape or by one blocker alone.

// Does the convex blocker occlude the emitter from all of the tile? Its chord between the vertices furthest to either side must separate
// the two, and its ends must lie beyond every line from the tile to the light.
inline bool hides(const Vec2d* v, std::size_t count, const Emitter& e, const TileRectangle& tile) {
  const Vec2d axis = e.center - tile.center;
  Vec2d left = v[0], right = v[0];
  for (std::size_t k = 1; k < count; ++k) {
    if (cross(axis, v[k]) > cross(axis, left)) left = v[k];
    if (cross(axis, v[k]) < cross(axis, right)) right = v[k];
  }
  const Vec2d chord = right - left;
  const double size = length(chord);
  if (size == 0) return false;
  for (Vec2d end : {e.a, e.b})
    // The light must be beyond the chord, not on it: of coincident edges the light's is visible.
    if (cross(chord, end - left) <= (e.radius + 1e-9) * size) return false;
  for (double sx : {-1.0, 1.0})
    for (double sy : {-1.0, 1.0}) {
      const Vec2d corner{tile.center.x + sx * tile.half.x, tile.center.y + sy * tile.half.y};
      if (cross(chord, corner - left) >= 0) return false;
      const Vec2d to_left = left - corner, to_right = right - corner;
      for (Vec2d end : {e.a, e.b}) {
        const double past_left = -cross(to_left, end - corner), past_right = cross(to_right, end - corner);
        if (past_left <= 0 || past_left * past_left < e.radius * e.radius * dot(to_left, to_left)) return false;
        if (past_right <= 0 || past_right * past_right < e.radius * e.radius * dot(to_right, to_right)) return false;
      }
    }
  return true;
}

// Is the arc on the far side of its ellipse for all of the tile? Visible are the places n of the unit circle with n . p > 1. Some of an arc
// is visible if one of its ends is; or, from its middle's side, other parts may be.
inline bool faces_away(const Emitter& arc, const TileRectangle& tile) {
  const double det = cross(arc.ellipse.x, arc.ellipse.y);
  const Vec2d center = arc.ellipse.to_unit(tile.center);
  const auto most = [&](double tau) {
    const Vec2d n{std::cos(tau), std::sin(tau)};
    const Vec2d along{n.x * arc.ellipse.y.y - n.y * arc.ellipse.x.y, n.y * arc.ellipse.x.x - n.x * arc.ellipse.y.x};
    return dot(n, center) + (std::fabs(along.x) * tile.half.x + std::fabs(along.y) * tile.half.y) / det;
  };
  return most(arc.tau0) <= 1 && most(arc.tau0 + arc.tau_span) <= 1 && most(arc.tau0 + 0.5 * arc.tau_span) <= 0;
}

}  // namespace steradian::plane
