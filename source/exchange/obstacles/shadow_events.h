// The lines of an element on which the hidden part of another one, seen from its points, is not smooth.
#pragma once

#include <vector>

#include "exchange/pairs/plane_element.h"
#include "shadow/edges/edges.h"
#include "steradian/vector2.h"

namespace steradian::exchange {

// A segment in the plane of the receiving element, in coordinates along `axes` from `origin`.
struct EventSegment {
  Vec2d a, b;
};

// Coordinates in the plane of an element.
struct ElementPlane {
  Vec3d origin;
  Frame axes;  // z is the normal
  Vec2d to_plane(Vec3d p) const {
    const Vec3d local = axes.to_local(p - origin);
    return {local.x, local.y};
  }
  Vec3d to_world(Vec2d p) const { return origin + axes.x * p.x + axes.y * p.y; }
};

// Edges of obstacles projected from corners of the target, edges of the target from corners of obstacles, edges of obstacles from corners
// of others, and the planes of obstacles. Not clipped to the element.
std::vector<EventSegment> shadow_events(const ElementPlane& plane, double size, const PlaneElement& target,
                                        const shadow::EdgeMesh& obstacles);

}  // namespace steradian::exchange
