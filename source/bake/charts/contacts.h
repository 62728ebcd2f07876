// Contacts: the lines where things stand on a plane chart, or cut through it. They part lit regions, and bound covered ones.
//
// A wall that is thinner than a texel leaves light on one side only. So a chart that contacts part is cut into a chart for each region,
// each with texels of its own, and its mesh gets the cut triangles. What stands on a chart without parting it only covers a part of it.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/charts/chart.h"
#include "bake/charts/mesh_cutter.h"
#include "core/progress.h"
#include "render/surface/ray_scene.h"

namespace steradian::bake {

// Cuts the charts, which are still in metres, and replaces them by those of the cut scene.
//
//   texels    a metre: regions of less than a hundredth of a texel do not count
//   work      steps of about a nanosecond; where contacts take more, the other charts stay whole, and a warning says so
//   progress  takes the fraction of the charts that are looked at
CutScene cut_at_contacts(Scene scene, std::vector<Chart>& charts, double texels, std::uint64_t work, const WorkFraction& progress = {});

}  // namespace steradian::bake
