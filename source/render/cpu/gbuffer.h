// Fills the G-buffer of a tile by tracing primary rays.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cpu/camera_rays.h"
#include "render/cpu/ray_scene.h"
#include "render/cpu/surface.h"
#include "render/cpu/tile.h"
#include "steradian/render.h"

namespace steradian {

struct TileArea {
  int x, y, width, height;  // in the picture; at most kTileSide wide and high
};

// What the primary rays of a tile hit, by slot (tile_slot). geometry: index of the mesh, or RTC_INVALID_GEOMETRY_ID.
struct TileHits {
  std::array<unsigned, kTilePixels> geometry, triangle;
  std::array<float, kTilePixels> u, v, distance;
  alignas(64) TileVector direction;
};

// One primary ray per pixel, through `place` within the pixel. behind: nothing nearer than that is hit, and nothing at all where it
// is 0; null: from the camera on.
void trace_tile(const RayScene& rays, const CameraRays& camera, TileArea area, PixelPlace place, TileHits& hits,
                const TilePlane* behind = nullptr);

struct SurfacePacks;

// How hits become surfaces.
struct Shading {
  const SurfacePacks& packs;
  Terminator terminator = Terminator::strict;
  const MipMaps* maps = nullptr;  // of the scene's images, for means over what pixels cover of them; null: textures at points
  PixelSteps steps = {};
};

// The surfaces that were hit, plain meshes on packs, where the terminator lights them from. tile.radiance becomes the emission.
void shade_tile(const Scene& scene, const Shading& shading, const TileHits& hits, SurfaceTile& tile);

// A tile that holds nothing in any slot is what these begin with: its kinds are none.
void clear_kinds(SurfaceTile& tile);
// Empties a slot: what packs read there is finite and weighs nothing.
void put_nothing(SurfaceTile& tile, std::size_t slot);
// The surface, its emission as radiance, and what kinds the tile now holds.
void put_surface(SurfaceTile& tile, std::size_t slot, const Surface& surface, Vec3f view);

// Some slots of a tile, side by side at the beginning of another one whose first `filled` slots may hold something; all radiance 0.
// Returns how many.
std::size_t take_slots(const SurfaceTile& from, const std::vector<std::uint32_t>& slots, std::size_t filled, SurfaceTile& to);

// The coats of a tile that have a normal of their own, each in its slot of another tile, as surfaces of which the coat is the one
// lobe; in `from` they weigh nothing until they are put back. False where there is none: `to` is as it was then.
//
// Coats see lights past another horizon than what lies below them, so that what is visible of a light is another part.
bool take_coats(SurfaceTile& from, SurfaceTile& to);
// With the light that they reflect.
void put_back_coats(const SurfaceTile& coats, SurfaceTile& to);

// The surface in a slot that has one, put together again.
Surface surface_in(const SurfaceTile& tile, std::size_t slot);

}  // namespace steradian
