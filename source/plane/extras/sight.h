// What a point sees in a scene with extras, exactly: the lower envelope of what ends light, the parts of it that mirrors show, and the gaps
// that suns are seen through, each cut where what it passes changes. Between cuts, closed forms, or quadrature where light fades on its
// way.
#pragma once

#include "plane/exact/emission.h"
#include "plane/extras/view.h"

namespace steradian::plane {

struct SightRules {
  double tolerance = 1e-10;  // of the quadrature, in shares of the brightest that is seen
  bool all = true;           // else only what a frame without extras lacks; clear bodies and fog change all of it
  EmissionParts parts = EmissionParts::radiance_and_moments;
};

// Radiance averaged over directions, and its moments. The view is one of a disk that the point is in.
PlaneLight sight(const World& world, const View& view, Vec2d from, const SightRules& rules);

// The same of a single point.
PlaneLight sight_from(const World& world, Vec2d from);

}  // namespace steradian::plane
