// What reaches into the lights of a frame, and is seen from within them.
#pragma once

#include <cstdint>
#include <functional>

#include "core/budget.h"
#include "plane/frame/blocker_bins.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

// Fills FrameScene::interior. `spend` is told the steps that this takes, and may throw.
void find_interiors(FrameScene& frame, const BlockerBins& bins, Budget& budget, const std::function<void(std::uint64_t)>& spend);
// Of one body, anew.
void find_interior(FrameScene& frame, std::size_t body, const BlockerBins& bins, Budget& budget,
                   const std::function<void(std::uint64_t)>& spend);

}  // namespace steradian::plane
