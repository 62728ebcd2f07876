#include <algorithm>

#include "steradian/view_factors.h"

namespace steradian {

ViewFactors without_small_factors(const ViewFactors& factors, double smallest) {
  ViewFactors result = factors;
  std::vector<double> left_out(factors.size(), 0.0);  // exchange area of a row
  for (std::size_t at = 0; at < factors.blocks.size(); ++at) {
    const ExchangeBlock& from = factors.blocks[at];
    ExchangeBlock& to = result.blocks[at];
    to.columns.clear();
    to.values.clear();
    to.errors.clear();
    for (std::size_t r = 0; r < from.rows(); ++r) {
      const std::size_t i = from.first_row + r;
      for (std::size_t k = from.row_start[r]; k < from.row_start[r + 1]; ++k) {
        const std::size_t j = from.columns[k];
        if (from.values[k] < smallest * std::min(factors.areas[i], factors.areas[j])) {
          left_out[i] += from.values[k];
          left_out[j] += from.values[k];
          continue;
        }
        to.columns.push_back(from.columns[k]);
        to.values.push_back(from.values[k]);
        to.errors.push_back(from.errors[k]);
      }
      to.row_start[r + 1] = to.columns.size();
    }
  }
  // The errors of these entries are in the row's error already.
  for (std::size_t i = 0; i < factors.size(); ++i) {
    result.row_sums[i] = std::max(factors.row_sums[i] - left_out[i] / factors.areas[i], 0.0);
    result.row_errors[i] = factors.row_errors[i] + left_out[i] / factors.areas[i];
  }
  return result;
}

}  // namespace steradian
