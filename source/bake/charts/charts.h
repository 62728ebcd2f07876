// Cuts the meshes of a scene into charts.
//
// A mesh with a second set of texture coordinates keeps the charts that these describe. Any other is cut where it bends: a chart is a plane
// part, a grid of curved quadrilaterals (grid_charts.h), or a part of a finely divided smooth surface whose triangles face within 40
// degrees of one direction, seen from there.
#pragma once

#include <string>
#include <vector>

#include "bake/charts/chart.h"

namespace steradian::bake {

// True if a mesh takes a map: it is lit, and light does not go through it.
bool takes_light(const Scene& scene, const Mesh& mesh);

struct Charts {
  std::vector<Chart> charts;          // in metres
  std::vector<std::string> warnings;  // whole sentences
  std::size_t without_area = 0;       // triangles in no chart
};

// Throws Error(place, ...) with the mesh's name where its vertices are incomplete or not finite, and where its texture coordinates fold,
// overlap in a chart, or have no area. texels: a metre.
Charts charts_of(const Scene& scene, double texels, const std::string& place);

}  // namespace steradian::bake
