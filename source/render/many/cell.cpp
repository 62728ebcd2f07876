#include "render/many/cell.h"

#include <cmath>
#include <numbers>

namespace steradian::lights {
namespace {

double chebyshev(int degree, double x) { return std::cos(degree * std::acos(x)); }

NodeRow make_row(int n) {
  NodeRow row;
  for (int j = 0; j < n; ++j) {
    const double x = std::cos(std::numbers::pi * (j + 0.5) / n);
    const auto column = static_cast<std::size_t>(j);
    row.node[column] = static_cast<float>(x);
    for (int i = 0; i < n; ++i)
      row.to_factors[static_cast<std::size_t>(i)][column] = static_cast<float>((i == 0 ? 1.0 : 2.0) / n * chebyshev(i, x));
  }
  return row;
}

}  // namespace

double lebesgue(int nodes) { return 2 * std::numbers::inv_pi * std::log(nodes) + 1; }

const NodeRow& node_row(int nodes) {
  static const std::array<NodeRow, 4> rows = {make_row(1), make_row(2), make_row(4), make_row(8)};
  return rows[nodes >= 8 ? 3 : static_cast<std::size_t>(nodes) / 2];
}

}  // namespace steradian::lights
