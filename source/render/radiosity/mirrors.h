// Mirrors: the rays along which narrow lobes show other surfaces to the viewer, one for each surface of a tile.
#pragma once

#include "render/surface/passed_rays.h"

namespace steradian::radiosity {

// Makes the rays of what a tile's mirrors show. distance: of the tile's surfaces from the viewer, along the way. Returns false if there is
// no mirror.
bool find_mirrored(const RayScene& rays, const SurfaceTile& tile, const TilePlane& distance, PassedRays::Ways& ways);

}  // namespace steradian::radiosity
