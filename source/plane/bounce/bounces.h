// The inside of PlaneBounces.
#pragma once

#include "plane/bounce/elements.h"
#include "steradian/plane_bounce.h"

namespace steradian {

struct PlaneBounces::Impl {
  const plane::World* world = nullptr;
  plane::BoundaryElements elements;
  PlaneBounceStats stats;
};

}  // namespace steradian
