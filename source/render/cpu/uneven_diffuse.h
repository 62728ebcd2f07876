// Diffuse light of lights that are not even: the exact irradiance times the texture, or the profile, as the cosine lobe sees it.
#pragma once

#include <vector>

#include "render/cpu/light_list.h"

namespace steradian {

// Those that packs finish alone.
std::vector<const PackLight*> even_ones(const std::vector<const PackLight*>& lights);

// Adds albedo / pi times the irradiance of the uneven ones among the lights to tile.radiance. Point by point.
void add_diffuse_from_uneven(SurfaceTile& tile, const std::vector<const PackLight*>& lights);

}  // namespace steradian
