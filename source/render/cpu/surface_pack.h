// Surfaces on packs: most of a G-buffer's pixels, sixteen neighbours on one mesh at a time.
//
// A mesh without textures, colours at its vertices and layers that depend on the view has the lobes of any one of its points
// (surface.h); only position, normals and view change from pixel to pixel. The textures that most materials have are looked up on packs.
#pragma once

#include <cstdint>

#include "core/simd.h"
#include "render/cpu/gbuffer.h"
#include "render/cpu/surface.h"

namespace steradian {

enum class SurfaceKind {
  plain,     // the same lobes all over
  textured,  // by base colour, metalness and roughness, normal, emission, specular reflection
  layered,   // what is computed point by point
};
SurfaceKind kind_of(const Scene& scene, const Mesh& mesh);

struct SurfacePacks {
  // Fill the slots of a block of 16 (from `first` on) whose bits are set in `slots`: hits of the mesh. They return the slots that they have
  // filled; others have corners or normals whose squares leave the range of float.
  std::uint32_t (*fill_plain)(const Mesh& mesh, const Surface& like, const TileHits& hits, std::size_t first, std::uint32_t slots,
                              SurfaceTile& tile);
  // Of a textured mesh; `shading` has maps.
  std::uint32_t (*fill_textured)(const Scene& scene, const Mesh& mesh, const Shading& shading, const TileHits& hits, std::size_t first,
                                 std::uint32_t slots, SurfaceTile& tile);
};

STERADIAN_DECLARE_PACK_TABLE(SurfacePacks, surface_packs)

}  // namespace steradian
