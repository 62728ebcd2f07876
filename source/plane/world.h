// The inside of a PlaneWorld: bodies, their curves, and where they are.
#pragma once

#include <vector>

#include "plane/emission.h"
#include "plane/outline.h"
#include "plane/ray_grid.h"

namespace steradian {

struct PlaneWorld::Impl {
  PlaneScene scene;
  std::vector<Curve> curves;             // of all bodies, in the scene's order
  std::vector<std::size_t> first_curve;  // by body, and the number of curves at the end
  std::vector<Box> boxes;                // by body
  RayGrid grid;

  // What fills the point: an occluder wins, then the last light. -1: nothing.
  struct Inside {
    int body = -1;
    bool dark = false;
  };
  Inside inside(Vec2d p) const;
};

// The exact method over a chosen set of curves.
PlaneLight envelope_light(const PlaneWorld::Impl& world, const std::vector<const Curve*>& curves, Vec2d from,
                          int inside_light, EmissionParts parts = EmissionParts::radiance_and_moments);
// The same for one light; the others block.
PlaneLight envelope_light_of(const PlaneWorld::Impl& world, const std::vector<const Curve*>& curves, Vec2d from,
                             int only, EmissionParts parts);
// Radiance within a light, where all that can be seen are these parts of other outlines, and the light between them.
Vec3d light_between(const PlaneWorld::Impl& world, const std::vector<Curve>& parts, Vec2d from, int inside_light);
PlaneLight par_light(const PlaneWorld::Impl& world, Vec2d from);
PlaneLight sampled_light(const PlaneWorld::Impl& world, Vec2d from, const PlaneSampling& sampling);
PlaneLight marched_light(const PlaneWorld::Impl& world, Vec2d from, const PlaneSampling& sampling);

}  // namespace steradian
