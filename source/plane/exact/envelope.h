// The lower envelope of curves from a point: in every direction, the curve that is hit first.
#pragma once

#include <vector>

#include "plane/exact/outline.h"

namespace steradian::plane {

// A part of a curve over the directions from angle begin to angle end, -pi <= begin < end <= pi.
struct Visible {
  double begin, end;
  const Curve* curve;
  bool back;  // is its inner face visible?
};

struct EnvelopeRules {
  // Inner faces of this body are visible (the point is inside it); -1 for none.
  int inside = -1;
};

// The whole envelope, by rising angle; gaps where there is no curve. `bodies` tells by index who wins coincident edges. O(n log n) by
// divide and conquer; crossings are found geometrically, so that curves may overlap in any way.
std::vector<Visible> lower_envelope(const std::vector<const Curve*>& curves, Vec2d from, const std::vector<PlaneBody>& bodies,
                                    const EnvelopeRules& rules);

// Distance to the curve in direction u (unit), on the near or the far branch of an arc. The curve must be visible in that direction.
double distance_along(const Curve& curve, bool back, Vec2d from, Vec2d u);

}  // namespace steradian::plane
