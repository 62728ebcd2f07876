// Rules of Gauss and Legendre on [0, 1] with 1 to 16 nodes, in double.
#pragma once

#include <cstddef>
#include <vector>

namespace steradian::exchange {

inline constexpr int kMostNodes = 16;

struct GaussRule {
  std::vector<double> node, weight;  // the weights add up to 1
};

// The rule with n nodes, 1 <= n <= kMostNodes.
const GaussRule& gauss_rule(int n);

}  // namespace steradian::exchange
