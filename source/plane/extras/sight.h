// The light that a point receives in a scene with extras, exactly. It uses the lower envelope of the curves that end light, the parts of it
// that mirrors show, and the gaps in which suns are visible. Each is cut where the bodies that its light passes change. Between cuts there
// are closed forms, or quadrature if light fades along its path.
#pragma once

#include "plane/exact/emission.h"
#include "plane/extras/view.h"

namespace steradian::plane {

struct SightRules {
  double tolerance = 1e-10;  // for the quadrature, as a fraction of the brightest visible value
  bool all = true;           // false: only the light that a frame without extras lacks; clear bodies and fog change all of it
  EmissionParts parts = EmissionParts::radiance_and_moments;
};

// Radiance averaged over directions, and its moments. The view belongs to a disk that contains the point.
PlaneLight sight(const World& world, const View& view, Vec2d from, const SightRules& rules);

// The same for a single point.
PlaneLight sight_from(const World& world, Vec2d from);

}  // namespace steradian::plane
