// Pairs of a round light and what may block it, with their event lines.
#pragma once

#include "plane/frame/events.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

// Appends a pair for each of the blockers, in their order.
void append_event_pairs(FrameScene& frame, const Emitter& disk, const std::vector<int>& blockers);

}  // namespace steradian::plane
