// Mirrors: the rays along which narrow lobes show other surfaces to the viewer, one for each surface of a tile.
#pragma once

#include "render/surface/passed_rays.h"

namespace steradian::radiosity {

// The mirrors of a tile, by slot.
struct Mirrors {
  PassedRays::Ways ways;  // the mirrored rays; the shares are the fraction that the lobes reflect
  TileVector normal;      // of the lobes
  TilePlane alpha_x, alpha_y;
};

// Finds a tile's mirrors. distance: of the tile's surfaces from the viewer, along the way. Returns false if there is no mirror.
bool find_mirrors(const RayScene& rays, const SurfaceTile& tile, const TilePlane& distance, Mirrors& mirrors);

// Fraction of a GGX lobe's light from other surfaces that mirrored rays show. The lobe's own directions (Gather) show the rest. Narrow
// lobes are all mirror, and wide ones none; both join without a step.
float mirrored_fraction(float alpha_x, float alpha_y);

}  // namespace steradian::radiosity
