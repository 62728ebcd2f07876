// Fractions of a light by stratified rays: where there are too many edges to arrange, and for light through cut-outs.
#pragma once

#include "render/surface/ray_scene.h"
#include "render/shadow/side.h"
#include "shadow/region/visible.h"

namespace steradian {

// Visible fraction of the light above the point's horizons, past all occluders.
double share_by_rays(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at);

// Fraction of the light that passes cut-outs. The second function takes only the part of the light that `seen` found in `segments`.
double share_past_cut_outs(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at);
double share_past_cut_outs(const RayScene& rays, const LightSide& side, const shadow::Viewpoint& at, const shadow::SegmentSet& segments,
                           const shadow::VisibleRegion& seen);

}  // namespace steradian
