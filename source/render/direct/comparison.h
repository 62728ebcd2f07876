// Methods of GGX for comparison only, at many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/direct/ltc_points.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian {

// Radiance for a light of radiance 1: `plain` with F = 1, `fresnel` with F = (1 - v.h)^5. Lobes are isotropic and use alpha_x.
struct ComparisonTable {
  void (*clipless)(const PackLight& light, const Points& points, const LtcPackTables& classic, float* plain, float* fresnel);
  void (*representative_point)(const PackLight& light, const Points& points, float* plain, float* fresnel);
};

STERADIAN_DECLARE_PACK_TABLE(ComparisonTable, comparison_table)

}  // namespace steradian
