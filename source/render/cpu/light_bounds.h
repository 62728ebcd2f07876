// What boxes of surfaces' positions and normals say of lights.
#pragma once

#include "render/cpu/light_list.h"

namespace steradian {

inline bool any_surface(const SurfaceBounds& bounds) { return bounds.low.x <= bounds.high.x; }
void add(SurfaceBounds& to, const SurfaceBounds& other);
// Those of `count` of a tile's slots; coats have normals of their own.
void add(SurfaceBounds& to, const SurfaceTile& tile, std::size_t first, std::size_t count);

// Whether the light may reach one of the surfaces: by its plane and their horizons.
bool reaches(const PackLight& light, const SurfaceBounds& surfaces);

// Whether each of the surfaces surely has all of an area light above its horizon, and sees the lit side of a flat one.
//
//   spread   by which round lights count as larger
bool sees_whole(const PackLight& light, const SurfaceBounds& surfaces, float spread = 1);

}  // namespace steradian
