// Tables of linearly transformed cosines in the form that packs and shaders read.
#pragma once

#include <vector>

#include "integrals/tables/table.h"
#include "steradian/method.h"

namespace steradian {

// A table in the form that packs read: nodes of four floats, so that one load reads a node.
struct PackTable {
  int size = 0;
  std::vector<float> nodes;
};

// classic: matrix and magnitude; compact: shapes and magnitudes. fresnel: classic, and tables of the lobe times (1 - v.h)^5. If the latter
// are empty, f_A replaces them.
struct LtcPackTables {
  PackTable matrix, magnitude;
  PackTable fresnel_matrix = {}, fresnel_magnitude = {};
  bool compact = false;
  bool fitted = false;  // the lobe's place and width are the table's own
};

// The table by which a method integrates GGX: the shipped one, or for `ltc` the fitted one if it is not null. Empty if the method has none.
LtcPackTables ltc_pack_tables(Method method, Quality quality = Quality::normal, const ClassicTable* fitted = nullptr);

}  // namespace steradian
