// Tests of lights against boxes of surfaces' positions and normals.
#pragma once

#include "render/lights/light_list.h"

namespace steradian {

void add(SurfaceBounds& to, const SurfaceBounds& other);
// Adds `count` of a tile's slots. Coats add normals of their own.
void add(SurfaceBounds& to, const SurfaceTile& tile, std::size_t first, std::size_t count);

// True if the light may reach one of the surfaces, by its plane and their horizons.
bool reaches(const PackLight& light, const SurfaceBounds& surfaces);

// True if all of an area light surely lies above every surface's horizon, and every surface faces the lit side of a flat light.
//
//   spread   factor by which round lights count as larger
bool sees_whole(const PackLight& light, const SurfaceBounds& surfaces, float spread = 1);

}  // namespace steradian
