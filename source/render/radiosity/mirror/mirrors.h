// Mirrors: the rays along which narrow lobes show other surfaces to the viewer, one for each surface of a tile.
#pragma once

#include <array>
#include <cstdint>

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

// A direction below the triangle's horizon moves onto it. Else the last facets before a smooth outline would be black.
Vec3f above_triangle(Vec3f direction, Vec3f geometric_normal);

// Number of pixels that the ray of each stands for; 0: it has no ray.
using StandsFor = std::array<std::uint8_t, kTilePixels>;

// Some mirrors of a tile, side by side in the slots of another one.
struct SomeMirrors {
  Mirrors mirrors;
  std::array<std::uint32_t, kTilePixels> source;  // of each slot: the slot in the original tile, or kNoSlot
};
// Chooses the mirrors whose rays are traced first: one pixel of 2 x 2 stands for all four where lobes are many pixels wide.
//
//   pixel  size of a pixel at distance 1
void choose_first(const SurfaceTile& tile, const Mirrors& mirrors, float pixel, StandsFor& stands_for, SomeMirrors& some);
// Chooses the rest where that was not enough: what the first rays met is so near that the lobes spread over few pixels of it. reach: of the
// first rays. Returns false if there is none.
bool choose_rest(const Mirrors& mirrors, float pixel, const TilePlane& reach, StandsFor& stands_for, SomeMirrors& some);

// Slot of the pixel whose ray shows what the mirror of pixel (x, y) of a tile shows.
std::size_t traced_slot(const StandsFor& stands_for, int x, int y);

// Fraction of a GGX lobe's light from other surfaces that mirrored rays show. The lobe's own directions (Gather) show the rest. Narrow
// lobes are all mirror, and wide ones none; both join without a step.
float mirrored_fraction(float alpha_x, float alpha_y);

}  // namespace steradian::radiosity
