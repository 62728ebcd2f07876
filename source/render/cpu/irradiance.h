// Irradiance of polygon lights on many surface points at once, on packs.
#pragma once

#include <cstddef>

#include "core/simd.h"
#include "render/cpu/light_list.h"

namespace steradian {

// Structure of arrays. All arrays hold `count` floats, and `count` is a multiple of 16 (repeat the last point).
struct SurfacePoints {
  const float* x;
  const float* y;
  const float* z;
  const float* nx;  // unit normals
  const float* ny;
  const float* nz;
  std::size_t count;
};

struct IrradianceTable {
  // Irradiance of radiance 1 in [0, pi] at every point, of a light of kind polygon.
  void (*irradiance)(const PackLight& light, const SurfacePoints& points, float* result);
};

STERADIAN_DECLARE_PACK_TABLE(IrradianceTable, irradiance_table)

}  // namespace steradian
