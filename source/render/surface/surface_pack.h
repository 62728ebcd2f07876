// Surfaces on packs: most of a G-buffer's pixels, sixteen neighbours on one mesh at a time.
//
// A mesh without textures, vertex colours and layers that depend on the view has the same lobes at all points (surface.h). Only position,
// normals and view change from pixel to pixel. The textures that most materials have are looked up on packs.
#pragma once

#include <cstdint>

#include "core/simd.h"
#include "render/surface/gbuffer.h"
#include "render/surface/surface.h"

namespace steradian {

enum class SurfaceKind {
  plain,     // the same lobes everywhere
  textured,  // textures of base colour, metalness and roughness, normal, emission, specular reflection
  layered,   // anything else: computed point by point
};
SurfaceKind kind_of(const Scene& scene, const Mesh& mesh);

struct SurfacePacks {
  // Fill those slots of a block of 16 (from `first` on) whose bits are set in `slots`, all hits of the mesh. They return the slots that
  // they have filled. The others have corners or normals whose squares are out of the range of float.
  std::uint32_t (*fill_plain)(const Mesh& mesh, const Surface& like, const TileHits& hits, std::size_t first, std::uint32_t slots,
                              SurfaceTile& tile);
  // For a textured mesh; `shading` must have maps.
  std::uint32_t (*fill_textured)(const Scene& scene, const Mesh& mesh, const HitShading& shading, const TileHits& hits, std::size_t first,
                                 std::uint32_t slots, SurfaceTile& tile);
};

STERADIAN_DECLARE_PACK_TABLE(SurfacePacks, surface_packs)

}  // namespace steradian
