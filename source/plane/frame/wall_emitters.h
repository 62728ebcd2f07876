// Walls that reflect light (plane/bounce) as emitters of a frame.
#pragma once

#include <vector>

#include "plane/bounce/bounces.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

enum class WallLight { radiance, error };

// Emitters of all elements, with edges in the runs of their walls.
std::vector<Emitter> wall_emitters(const PlaneBounces::Impl& bounces, WallLight what);

}  // namespace steradian::plane
