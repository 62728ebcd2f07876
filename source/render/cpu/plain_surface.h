// Surfaces that look the same all over, on packs: most of a G-buffer's pixels.
//
// A plain mesh has no textures, no colours at its vertices and no layers that depend on the view; its lobes are those of any one of its
// points (surface.h), and only position, normals and view change from pixel to pixel.
#pragma once

#include <cstdint>

#include "core/simd.h"
#include "render/cpu/gbuffer.h"
#include "render/cpu/surface.h"

namespace steradian {

// Whether all of the mesh has the same lobes.
bool is_plain(const Scene& scene, const Mesh& mesh);

struct PlainSurfaceTable {
  // Fills the slots of a block of 16 (from `first` on) whose bits are set in `slots`: hits of the plain mesh, of which `like` is one
  // surface. Returns the slots that it has filled; others have corners or normals whose squares leave the range of float.
  std::uint32_t (*fill)(const Mesh& mesh, const Surface& like, const TileHits& hits, std::size_t first, std::uint32_t slots,
                        SurfaceTile& tile);
};

STERADIAN_DECLARE_PACK_TABLE(PlainSurfaceTable, plain_surface_table)

}  // namespace steradian
