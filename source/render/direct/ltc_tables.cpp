#include "render/direct/ltc_tables.h"

#include <optional>

#include "integrals/methods.h"
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

LtcPackTables ltc_pack_tables(Method method, Quality quality, const ClassicTable* fitted) {
  const LtcTableView t = ltc_ggx_tables();
  if (method == Method::ltc && fitted != nullptr)
    return {padded(fitted->matrix.front().data(), fitted->size, 4),
            padded(fitted->magnitude.front().data(), fitted->size, 4),
            {},
            {},
            false,
            true};
  const std::optional<LtcMethod> form = methods::ltc_method(method, quality);
  if (!form) return {};
  switch (*form) {
    case LtcMethod::compact: return {padded(t.shapes, t.shape_size, 4), padded(t.magnitudes, t.magnitude_size, 2), {}, {}, true};
    case LtcMethod::fresnel:
      return {padded(t.matrix, t.classic_size, 4), padded(t.magnitude, t.classic_size, 4), padded(t.fresnel_matrix, t.classic_size, 4),
              padded(t.fresnel_magnitude, t.classic_size, 4)};
    case LtcMethod::classic:
    case LtcMethod::clipless: return {padded(t.matrix, t.classic_size, 4), padded(t.magnitude, t.classic_size, 4)};
    case LtcMethod::representative_point: return {};
  }
  return {};
}

}  // namespace steradian
