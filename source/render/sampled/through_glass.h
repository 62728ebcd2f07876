// Light through solids of rough glass, by random facets: the reference of the lobes of RoughGlass.
#pragma once

#include "render/sampled/paths.h"
#include "render/surface/passed_rays.h"

namespace steradian {

// Light from behind a face of rough glass.
//
//   passes   fraction that the face lets through
//   bounces  as trace_paths; the glass is one of them
Estimate trace_through(const PathScene& scene, const PassedRays& passed, const Surface& face, Vec3f view, Vec3f passes, int bounces,
                       int paths, reference::Random& random);

}  // namespace steradian
