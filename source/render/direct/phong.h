// Phong lobes under polygon lights on many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"
#include "steradian/phong.h"

namespace steradian {

struct PhongTable {
  // Radiance in [0, 1] of albedo 1 at every point, under a polygon of radiance 1. Options as in steradian/phong.h, unchecked; exact is the
  // quadrature with 14 nodes. Arvo's recurrence wants denormals flushed (core/float_mode.h).
  void (*radiance)(const PackLight& light, const Points& points, double exponent, const PhongOptions& options, float* result);
};

STERADIAN_DECLARE_PACK_TABLE(PhongTable, phong_table)

}  // namespace steradian
