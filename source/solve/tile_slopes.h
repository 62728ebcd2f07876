// Derivatives of the light of a polygon on a tile's surfaces by motions of its vertices, on packs (kernels/integral/slopes.glsl).
#pragma once

#include <vector>

#include "core/simd.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian::solving {

// Velocity of each vertex of PackLight::polygon, in its order.
using VertexMotion = std::vector<Vec3f>;

struct TileSlopes {
  // Sets slopes[k] to the change of the radiance to the camera by motion k, for a light of radiance 1 without occluders: of the diffuse and
  // the GGX lobe. The mean direction by which the boundary dims the diffuse lobe counts as a constant.
  void (*find)(const SurfaceTile& tile, const PackLight& light, const std::vector<VertexMotion>& motions, TileVector* slopes);
};

}  // namespace steradian::solving

namespace steradian {

using solving::TileSlopes;
STERADIAN_DECLARE_PACK_TABLE(TileSlopes, tile_slopes)

}  // namespace steradian
