// Irradiance of area lights on many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian {

struct IrradianceTable {
  // Irradiance in [0, pi] that reaches the diffuse lobe at every point, from an area light of radiance 1.
  void (*irradiance)(const PackLight& light, const Points& points, float* result);
};

STERADIAN_DECLARE_PACK_TABLE(IrradianceTable, irradiance_table)

}  // namespace steradian
