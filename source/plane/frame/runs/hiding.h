// Tests that an emitter is invisible from all of a tile, by its own shape or by one blocker alone.
#pragma once

#include <cmath>

#include "plane/frame/scene.h"
#include "plane/frame/runs/silhouette.h"

namespace steradian::plane {

// Does the convex blocker occlude the emitter from all of the tile? Its chord between the vertices furthest to either side must separate
// the two, and its ends must lie beyond every line from the tile to the light.
inline bool hides(const Vec2d* v, std::size_t count, const Emitter& e, const TileArea& tile) {
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
inline bool faces_away(const Emitter& arc, const TileArea& tile) {
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
