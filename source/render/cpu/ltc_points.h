// Lambert and GGX from polygon lights by linearly transformed cosines, on many points at once, on packs.
#pragma once

#include <cstddef>
#include <vector>

#include "core/simd.h"
#include "integrals/ltc/table.h"
#include "render/cpu/light_list.h"
#include "render/cpu/points.h"

namespace steradian {

// A table as packs read it: nodes of four floats, so that one load takes a node.
struct PackTable {
  int size = 0;
  std::vector<float> nodes;
};

// The shipped tables. classic: matrix and magnitude; compact: shapes and magnitudes. fresnel: classic, and those of the lobe times
// (1 - v.h)^5, which are empty otherwise: then f_A stands for it.
struct LtcPackTables {
  PackTable matrix, magnitude;
  PackTable fresnel_matrix = {}, fresnel_magnitude = {};
};
LtcPackTables ltc_classic_pack_tables();
LtcPackTables ltc_fresnel_pack_tables();
LtcPackTables ltc_pack_tables(const ClassicTable& table);
LtcPackTables ltc_compact_pack_tables();

// What light of radiance 1 does to every point.
struct LtcSums {
  float* irradiance;  // that reaches the diffuse lobe, in [0, pi]; null: not wanted
  float* specular;    // for F0 = 1 and F90 = 1: n_A times the lobe's integral
  float* grazing;     // what F90 - F0 multiplies: f_A times the same, or the Fresnel lobe's own
};

struct LtcPackTable {
  void (*classic)(const PackLight& light, const Points& points, const LtcPackTables& tables, const LtcSums& sums);
  void (*compact)(const PackLight& light, const Points& points, const LtcPackTables& tables, const LtcSums& sums);
};

STERADIAN_DECLARE_PACK_TABLE(LtcPackTable, ltc_pack_table)

}  // namespace steradian
