// Places charts in a map, so that no bilinear look-up at a place of a chart reads a texel of another one.
#pragma once

#include <string>
#include <vector>

#include "bake/charts/chart.h"

namespace steradian::bake {

inline constexpr int kLargestMap = 16384;  // texels a side, which graphics cards take

// Distance of a chart's border from the first texel's centre [texels]: four steps of a graphics card, which rounds places to 1/256.
inline constexpr double kInside = 1.0 / 64;

struct MapSize {
  int width = 0, height = 0;
};

// Makes the charts' coordinates texels. Each chart is stretched to a whole number of texels, so that its first and last texel centres lie
// on its border. Charts with doors keep the places of their plane's texels. Throws Error(place, ...) for maps of more than kLargestMap a
// side, with the name of the mesh whose chart is too large alone.
//
//   texels  a metre
//   advice  what to do about a map that is too large
MapSize place_charts(const Scene& scene, std::vector<Chart>& charts, double texels, const std::string& place, const std::string& advice);

}  // namespace steradian::bake
