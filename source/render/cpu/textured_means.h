// What the lobes of many points see of a textured light: its mean under each, on packs.
#pragma once

#include <cstdint>

#include "core/simd.h"
#include "render/cpu/ltc_points.h"

namespace steradian {

// Arrays of as many floats as there are points, a multiple of 16.
struct TexturedMeans {
  float *r, *g, *b;
  float* found;  // 1, or 0 where the mean is not wanted, or the lobe sees less than the light's cells: TexturedLight finds those
};

struct TexturedMeansTable {
  // The mean radiance of the light over what each point's lobe sees of it (TexturedLight::seen_by_diffuse, seen_by_ggx), where wanted > 0.
  // A pack of points splits the same cells, until the last of them has its mean.
  void (*diffuse)(const TexturedLight& light, const Points& points, const float* wanted, const TexturedMeans& means);
  // tables: ltc_compact_pack_tables(), of any widths
  void (*ggx)(const TexturedLight& light, const Points& points, const LtcPackTables& tables, const float* wanted,
              const TexturedMeans& means);
};

STERADIAN_DECLARE_PACK_TABLE(TexturedMeansTable, textured_means_table)

}  // namespace steradian
