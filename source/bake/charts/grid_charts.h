// Grid charts: parts of a curved surface whose quadrilaterals lie in rows and columns.
//
// Each edge of a quadrilateral is a power of two of texels long, or a power of two of edges is a texel long. So the texels of two charts
// lie at the same places of a common edge, or every second one does, and both sides can show the same light there. Charts of another form
// have texels at other places of the edge.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/charts/chart.h"
#include "bake/charts/welded.h"

namespace steradian::bake {

// Charts for the curved triangles of a mesh, in metres of the map. Pairs of triangles become quadrilaterals, others charts of their own.
//
//   number  of the mesh
//   curved  by triangle: 1 for those that the charts shall hold
//   texels  a metre
std::vector<Chart> grid_charts(const Mesh& mesh, std::uint32_t number, const MeshNeighbours& neighbours,
                               const std::vector<std::uint8_t>& curved, double texels);

}  // namespace steradian::bake
