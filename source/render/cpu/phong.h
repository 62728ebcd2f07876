// Phong lobes under polygon lights on many surface points at once, on packs.
#pragma once

#include "render/cpu/irradiance.h"
#include "steradian/phong.h"

namespace steradian {

// Structure of arrays as SurfacePoints; unit vectors to the eye.
struct ViewedPoints {
  SurfacePoints surface;
  const float* vx;
  const float* vy;
  const float* vz;
};

struct PhongTable {
  // Radiance of albedo 1 under radiance 1 in [0, 1] at every point, of a polygon. Options as in steradian/phong.h, unchecked;
  // exact is the quadrature with 14 nodes. Arvo's recurrence wants denormals flushed (core/float_mode.h).
  void (*radiance)(const PackLight& light, const ViewedPoints& points, double exponent,
                   const PhongOptions& options, float* result);
};

STERADIAN_DECLARE_PACK_TABLE(PhongTable, phong_table)

}  // namespace steradian
