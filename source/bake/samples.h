// Places of a chart whose irradiance determines its texels: the middles of the parts of a fine grid that lie in the chart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/charts/chart.h"

namespace steradian::bake {

inline constexpr int kCellsPerTexel = 2;            // of the grid, along an axis
inline constexpr std::uint64_t kBytesPerCell = 64;  // memory of a cell of the grid while the samples are found

struct Sample {
  Vec2d at;                    // in the map [texels]
  std::uint32_t triangle = 0;  // of the chart's mesh
  float u = 0, v = 0;          // barycentric coordinates: weights of its second and third corner
  double area = 0;             // for which it stands [m^2]
};

// The places of 4 x 4 neighbouring cells of the grid, row by row. Empty cells have no area.
using SampleBlock = std::array<Sample, 16>;

std::vector<SampleBlock> samples_of(const Chart& chart, const Mesh& mesh);

}  // namespace steradian::bake
