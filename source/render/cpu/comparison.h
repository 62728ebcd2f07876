// The methods of GGX that are there for comparison, at many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/cpu/light_list.h"
#include "render/cpu/ltc_points.h"
#include "render/cpu/points.h"

namespace steradian {

// For radiance 1: into `plain` with F = 1, into `fresnel` with F = (1 - v.h)^5. Isotropic lobes: alpha_x.
struct ComparisonTable {
  void (*clipless)(const PackLight& light, const Points& points, const LtcPackTables& classic, float* plain, float* fresnel);
  void (*representative_point)(const PackLight& light, const Points& points, float* plain, float* fresnel);
};

STERADIAN_DECLARE_PACK_TABLE(ComparisonTable, comparison_table)

}  // namespace steradian
