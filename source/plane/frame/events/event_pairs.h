// Pairs of a round light and its possible blockers, with their event lines.
#pragma once

#include "plane/frame/events/events.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

// Writes a pair for each of the blockers, in their order, from `first` on. FrameScene::pairs must have capacity for them.
void make_event_pairs(FrameScene& frame, const Emitter& disk, const std::vector<int>& blockers, std::size_t first);

}  // namespace steradian::plane
