// Lambert and GGX from polygon lights by linearly transformed cosines, on many points at once, on packs.
#pragma once

#include <cstddef>
#include <vector>

#include "core/simd.h"
#include "render/cpu/light_list.h"
#include "render/cpu/points.h"

namespace steradian {

// A table as packs read it: nodes of four floats, so that one load takes a node.
struct PackTable {
  int size = 0;
  std::vector<float> nodes;
};

// The shipped tables. classic: matrix and magnitude; compact: shapes and magnitudes.
struct LtcPackTables {
  PackTable matrix, magnitude;
};
LtcPackTables ltc_classic_pack_tables();
LtcPackTables ltc_compact_pack_tables();

// What light of radiance 1 does to every point.
struct LtcSums {
  float* irradiance;  // that reaches the diffuse lobe, in [0, pi]; null: not wanted
  float* specular;    // for F0 = 1 and F90 = 1: n_A times the lobe's integral
  float* grazing;     // f_A times the same: what F90 - F0 multiplies
};

struct LtcPackTable {
  void (*classic)(const PackLight& light, const Points& points, const LtcPackTables& tables, const LtcSums& sums);
  void (*compact)(const PackLight& light, const Points& points, const LtcPackTables& tables, const LtcSums& sums);
};

STERADIAN_DECLARE_PACK_TABLE(LtcPackTable, ltc_pack_table)

}  // namespace steradian
