#include "render/direct/ltc_points.h"

#include "integrals/tables/ggx_tables.h"
#include "steradian/ltc.h"

namespace steradian {
namespace {

PackTable padded(const float* values, int size, int components) {
  PackTable table{size, {}};
  for (int i = 0; i < size * size; ++i)
    for (int c = 0; c < 4; ++c) table.nodes.push_back(c < components ? values[i * components + c] : 0.0f);
  return table;
}

}  // namespace

LtcPackTables ltc_classic_pack_tables() {
  const LtcTableView t = ltc_ggx_tables();
  return {padded(t.matrix, t.classic_size, 4), padded(t.magnitude, t.classic_size, 4)};
}

LtcPackTables ltc_fresnel_pack_tables() {
  const LtcTableView t = ltc_ggx_tables();
  LtcPackTables tables = ltc_classic_pack_tables();
  tables.fresnel_matrix = padded(t.fresnel_matrix, t.classic_size, 4);
  tables.fresnel_magnitude = padded(t.fresnel_magnitude, t.classic_size, 4);
  return tables;
}

LtcPackTables ltc_pack_tables(const ClassicTable& table) {
  return {padded(table.matrix.front().data(), table.size, 4), padded(table.magnitude.front().data(), table.size, 4)};
}

LtcPackTables ltc_compact_pack_tables() {
  const LtcTableView t = ltc_ggx_tables();
  return {padded(t.shapes, t.shape_size, 4), padded(t.magnitudes, t.magnitude_size, 2)};
}

}  // namespace steradian
