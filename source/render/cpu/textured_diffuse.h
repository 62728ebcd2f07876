// Diffuse light of textured lights: the exact irradiance times the texture as the cosine lobe sees it.
#pragma once

#include <vector>

#include "render/cpu/light_list.h"

namespace steradian {

// Those that packs finish alone.
std::vector<const PackLight*> without_textured(const std::vector<const PackLight*>& lights);

// Adds albedo / pi times the irradiance of the textured ones among the lights to tile.radiance. Point by point.
void add_diffuse_from_textured(SurfaceTile& tile, const std::vector<const PackLight*>& lights);

}  // namespace steradian
