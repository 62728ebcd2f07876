// Bodies that reach into the lights of a frame, and are visible from within them.
#pragma once

#include <cstdint>
#include <functional>

#include "core/budget.h"
#include "plane/frame/scene.h"
#include "plane/frame/tiles/blocker_bins.h"

namespace steradian::plane {

// Fills FrameScene::interior. `spend` receives the steps that this takes, and may throw.
void find_interiors(FrameScene& frame, const BlockerBins& bins, Budget& budget, const std::function<void(std::uint64_t)>& spend);
// Computes the interior of one body again.
void find_interior(FrameScene& frame, std::size_t body, const BlockerBins& bins, Budget& budget,
                   const std::function<void(std::uint64_t)>& spend);

}  // namespace steradian::plane
