// Fills the G-buffer of a tile by tracing primary rays.
#pragma once

#include <cstdint>
#include <vector>

#include "render/surface/camera_rays.h"
#include "render/surface/ray_scene.h"
#include "render/surface/surface.h"
#include "render/tile/tile.h"
#include "steradian/render.h"

namespace steradian {

struct TileArea {
  int x, y, width, height;  // place and size in the picture; at most kTileSide wide and high
};

// Hits of a tile's primary rays, by slot (tile_slot). geometry: index of the mesh, or RTC_INVALID_GEOMETRY_ID.
struct TileHits {
  std::array<unsigned, kTilePixels> geometry, triangle;
  std::array<float, kTilePixels> u, v, distance;
  alignas(64) TileVector direction;
};

// Traces one primary ray per pixel, through `place` within the pixel. behind: a ray hits nothing nearer than this distance, and nothing at
// all where it is 0; null: rays start at the camera.
void trace_tile(const RayScene& rays, const CameraRays& camera, TileArea area, PixelPlace place, TileHits& hits,
                const TilePlane* behind = nullptr);

struct SurfacePacks;

// Settings for turning hits into surfaces.
struct HitShading {
  const SurfacePacks& packs;
  Terminator terminator = Terminator::strict;
  const MipMaps* maps = nullptr;  // mip maps of the scene's images, for means over pixel footprints; null: textures at points
  PixelSteps steps = {};
};

// Computes the surfaces that were hit, plain meshes on packs, at the positions that the terminator asks for. tile.radiance becomes the
// emission.
void shade_tile(const Scene& scene, const HitShading& shading, const TileHits& hits, SurfaceTile& tile);

// Clears the kinds of a tile. The functions below start from a tile without a surface in any slot.
void clear_kinds(SurfaceTile& tile);
// Empties a slot: packs read finite values there that weigh nothing.
void put_nothing(SurfaceTile& tile, std::size_t slot);
// Stores a surface in a slot, its emission as radiance, and updates the kinds that the tile holds.
void put_surface(SurfaceTile& tile, std::size_t slot, const Surface& surface, Vec3f view);

// Copies some slots of a tile, side by side, to the beginning of another tile, with radiance 0. Only the first `filled` slots of `to` may
// hold a surface before. Returns the number of slots.
std::size_t take_slots(const SurfaceTile& from, const std::vector<std::uint32_t>& slots, std::size_t filled, SurfaceTile& to);

// Moves coats that have a normal of their own into another tile, each in its slot, as surfaces whose only lobe is the coat. In `from` they
// weigh nothing until they are put back. Returns false and leaves `to` unchanged if there is no such coat.
//
// A coat's horizon differs from that of the layers below, so a different part of a light is visible to it.
bool take_coats(SurfaceTile& from, SurfaceTile& to);
// Puts the coats back, with the light that they reflect.
void put_back_coats(const SurfaceTile& coats, SurfaceTile& to);

// Reassembles the surface in a slot that holds one.
Surface surface_in(const SurfaceTile& tile, std::size_t slot);

// Sixteen neighbouring surfaces of a tile, for packets of rays.
struct SixteenSurfaces {
  static constexpr std::size_t kLanes = 16;
  std::array<Surface, kLanes> surface;
  std::array<Vec3f, kLanes> view;
  std::uint32_t lit = 0;  // bits of the surfaces that exist

  // Takes those from slot `first` on.
  void take(const SurfaceTile& tile, std::size_t first);
  // Calls use(lane) for the surfaces of some bits.
  template <class Use>
  static void each(std::uint32_t bits, Use use) {
    for (; bits != 0; bits &= bits - 1) use(static_cast<std::size_t>(std::countr_zero(bits)));
  }
};

}  // namespace steradian
