// Contacts: the lines where things stand on a plane chart, or cut through it. They part lit regions, and bound covered ones.
//
// A wall that is thinner than a texel leaves light on one side only. So a chart that contacts part is cut into a chart for each region,
// each with texels of its own, and its mesh gets the cut triangles. What stands on a chart without parting it only covers a part of it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bake/charts/chart.h"
#include "render/surface/ray_scene.h"

namespace steradian::bake {

// A corner of a triangle of a cut mesh, in the uncut one.
struct CutCorner {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{};  // of its corners
};

// The meshes that were cut, and where their triangles come from.
struct CutScene {
  Scene scene;
  std::vector<std::vector<std::array<CutCorner, 3>>> corners;  // by mesh and triangle; empty for a mesh that was not cut
  std::vector<std::string> warnings;
  std::size_t cut = 0;  // charts
};

// Cuts the charts, which are still in metres, and replaces them by those of the cut scene.
//
//   texels  a metre: regions of less than a hundredth of a texel do not count
CutScene cut_at_contacts(Scene scene, std::vector<Chart>& charts, double texels);

}  // namespace steradian::bake
