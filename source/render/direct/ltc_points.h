// Lambert and GGX from polygon lights by linearly transformed cosines, at many points at once, on packs.
#pragma once

#include <cstddef>
#include <vector>

#include "core/simd.h"
#include "integrals/tables/table.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian {

// A table in the form that packs read: nodes of four floats, so that one load reads a node.
struct PackTable {
  int size = 0;
  std::vector<float> nodes;
};

// The shipped tables. classic: matrix and magnitude; compact: shapes and magnitudes. fresnel: classic, and tables of the lobe times
// (1 - v.h)^5. If the latter are empty, f_A replaces them.
struct LtcPackTables {
  PackTable matrix, magnitude;
  PackTable fresnel_matrix = {}, fresnel_magnitude = {};
};
LtcPackTables ltc_classic_pack_tables();
LtcPackTables ltc_fresnel_pack_tables();
LtcPackTables ltc_pack_tables(const ClassicTable& table);
LtcPackTables ltc_compact_pack_tables();

// Results of light of radiance 1, for every point.
struct LtcSums {
  float* irradiance;  // irradiance that reaches the diffuse lobe, in [0, pi]; null: not wanted
  float* specular;    // for F0 = 1 and F90 = 1: n_A times the lobe's integral
  float* grazing;     // factor of F90 - F0: f_A times the same, or the Fresnel lobe's own integral
};

struct LtcPackTable {
  void (*classic)(const PackLight& light, const Points& points, const LtcPackTables& tables, const LtcSums& sums);
  void (*compact)(const PackLight& light, const Points& points, const LtcPackTables& tables, const LtcSums& sums);
};

STERADIAN_DECLARE_PACK_TABLE(LtcPackTable, ltc_pack_table)

}  // namespace steradian
