// Means of a textured light under the lobes of many points, on packs.
#pragma once

#include <cstdint>

#include "core/simd.h"
#include "render/direct/ltc_tables.h"
#include "render/tile/tile.h"

namespace steradian {

class TexturedLight;

// Arrays with one float per point, a multiple of 16.
struct TexturedMeans {
  float *r, *g, *b;
  float* found;  // 1; 0 if the mean is not wanted or the lobe sees less than the light's cells (TexturedLight computes those)
};

struct TexturedMeansTable {
  // Mean radiance of the light as each point's lobe sees it (TexturedLight::seen_by_diffuse, seen_by_ggx), where wanted > 0. A pack of
  // points splits the same cells, until its last point has its mean.
  void (*diffuse)(const TexturedLight& light, const Points& points, const float* wanted, const TexturedMeans& means);
  // tables: ltc_pack_tables(Method::ltc_compact), for GGX itself of any widths; or a fitted table, for its lobe.
  void (*ggx)(const TexturedLight& light, const Points& points, const LtcPackTables& tables, const float* wanted,
              const TexturedMeans& means);
};

STERADIAN_DECLARE_PACK_TABLE(TexturedMeansTable, textured_means_table)

}  // namespace steradian
