// Shares of a light by stratified rays: where there is too much to arrange, and what cut-outs let through.
#pragma once

#include "render/cpu/ray_scene.h"
#include "render/cpu/shadow_side.h"
#include "shadow/visible.h"

namespace steradian {

// Of the light, above the point's horizons: past everything.
double share_by_rays(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at);

// Of the light, or of the part of it that `seen` found in `segments`: past cut-outs.
double share_past_cut_outs(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at);
double share_past_cut_outs(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at, const shadow::SegmentSet& segments,
                           const shadow::VisibleRegion& seen);

}  // namespace steradian
