// Phong lobes under polygon lights on many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/cpu/light_list.h"
#include "render/cpu/points.h"
#include "steradian/phong.h"

namespace steradian {

struct PhongTable {
  // Radiance of albedo 1 under radiance 1 in [0, 1] at every point, of a polygon. Options as in steradian/phong.h, unchecked;
  // exact is the quadrature with 14 nodes. Arvo's recurrence wants denormals flushed (core/float_mode.h).
  void (*radiance)(const PackLight& light, const Points& points, double exponent, const PhongOptions& options, float* result);
};

STERADIAN_DECLARE_PACK_TABLE(PhongTable, phong_table)

}  // namespace steradian
