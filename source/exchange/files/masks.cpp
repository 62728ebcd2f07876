#include "exchange/files/masks.h"

#include <algorithm>
#include <map>

namespace steradian::exchange {

ViewFactors with_masks(const ViewFactors& factors, const std::vector<FaceMask>& masks) {
  ViewFactors result = factors;
  std::vector<std::map<std::uint32_t, double>> added(factors.size());
  for (const FaceMask& m : masks) {
    added[std::max(m.row, m.base)][static_cast<std::uint32_t>(std::min(m.row, m.base))] = m.area;
    result.areas[m.row] = m.area;
    result.areas[m.base] += m.area;
  }
  for (ExchangeBlock& block : result.blocks) {
    const ExchangeBlock old = std::move(block);
    block = {old.first_row, {0}, {}, {}, {}};
    for (std::size_t r = 0; r < old.rows(); ++r) {
      auto next = added[old.first_row + r].begin();
      const auto end = added[old.first_row + r].end();
      const auto add = [&](std::uint32_t column, double value, float error) {
        block.columns.push_back(column);
        block.values.push_back(value);
        block.errors.push_back(error);
      };
      for (std::size_t k = old.row_start[r]; k < old.row_start[r + 1]; ++k) {
        for (; next != end && next->first < old.columns[k]; ++next) add(next->first, next->second, 0);
        add(old.columns[k], old.values[k], old.errors[k]);
      }
      for (; next != end; ++next) add(next->first, next->second, 0);
      block.row_start.push_back(block.columns.size());
    }
  }
  result.sum_rows();
  // The exchange of a mask is exact. A base's error is that of its visible part, over a larger area.
  for (std::size_t i = 0; i < result.size(); ++i)
    result.row_errors[i] = factors.areas[i] > 0 ? factors.row_errors[i] * (factors.areas[i] / result.areas[i]) : 0.0;
  return result;
}

}  // namespace steradian::exchange
