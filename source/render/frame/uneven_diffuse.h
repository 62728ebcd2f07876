// Diffuse light of textured and profiled lights: exact irradiance times the texture or profile as the cosine lobe sees it. Past occluders,
// that is the mean over the visible part.
#pragma once

#include <vector>

#include "render/lights/light_list.h"
#include "shapes/plane_region.h"

namespace steradian {

// The lights that are neither textured nor profiled. Packs serve these alone.
std::vector<const PackLight*> even_ones(const std::vector<const PackLight*>& lights);

// Adds albedo / pi times the irradiance of the textured and profiled ones among the lights to tile.radiance, point by point.
void add_diffuse_from_uneven(SurfaceTile& tile, const std::vector<const PackLight*>& lights);

// The part of a textured or profiled light that a slot sees (PackLight of pieces), in the coordinates of its mean.
PlaneRegion visible_region(const PackLight& light, std::size_t slot, Vec3d position);

}  // namespace steradian
