// The inside of a PlaneWorld: bodies, their curves, and where they are.
#pragma once

#include <vector>

#include "plane/exact/emission.h"
#include "plane/exact/outline.h"
#include "plane/exact/ray_grid.h"

namespace steradian {

struct PlaneWorld::Impl {
  PlaneScene scene;
  std::vector<plane::Curve> curves;      // of all bodies, in the scene's order
  std::vector<std::size_t> first_curve;  // by body, and the number of curves at the end
  std::vector<plane::Box> boxes;         // by body
  plane::RayGrid grid;

  // What fills the point: an occluder wins, then the last light. -1: nothing.
  struct Inside {
    int body = -1;
    bool dark = false;
  };
  Inside inside(Vec2d p) const;
};

}  // namespace steradian

namespace steradian::plane {

using World = PlaneWorld::Impl;

// The exact method over a chosen set of curves.
PlaneLight envelope_light(const World& world, const std::vector<const Curve*>& curves, Vec2d from,
                          int inside_light, EmissionParts parts = EmissionParts::radiance_and_moments);
// The same for one light; the others block.
PlaneLight envelope_light_of(const World& world, const std::vector<const Curve*>& curves, Vec2d from,
                             int only, EmissionParts parts);
// Radiance within a light, where all that can be seen are these parts of other outlines, and the light between them.
Vec3d light_between(const World& world, const std::vector<Curve>& parts, Vec2d from, int inside_light);
PlaneLight par_light(const World& world, Vec2d from);
PlaneLight sampled_light(const World& world, Vec2d from, const PlaneSampling& sampling);
PlaneLight marched_light(const World& world, Vec2d from, const PlaneSampling& sampling);

}  // namespace steradian::plane
