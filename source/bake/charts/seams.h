// Seams: edges at which two charts of one smooth surface meet.
#pragma once

#include <array>
#include <vector>

#include "bake/charts/chart.h"

namespace steradian::bake {

struct Seam {
  std::array<std::uint32_t, 2> chart{};
  std::array<std::array<Vec2d, 2>, 2> ends;  // of the edge, in each chart; the same order
  double length = 0;                         // [m]
};

// Two triangles meet smoothly where positions and vertex normals of an edge agree. The charts may belong to different meshes. Doors are
// seams, too.
std::vector<Seam> seams_of(const Scene& scene, const std::vector<Chart>& charts);

// The charts in groups that seams join, in the order of their first charts.
std::vector<std::vector<std::uint32_t>> joined_charts(std::size_t charts, const std::vector<Seam>& seams);

}  // namespace steradian::bake
