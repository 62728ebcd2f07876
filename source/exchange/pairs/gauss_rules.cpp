#include "exchange/pairs/gauss_rules.h"

#include <array>
#include <cmath>
#include <numbers>

namespace steradian::exchange {
namespace {

// Newton's method on Legendre's polynomial, from Tricomi's first term for its zeros.
GaussRule rule_of(int n) {
  GaussRule rule;
  for (int k = n; k >= 1; --k) {
    long double x =
        std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(k) - 0.25L) / (static_cast<long double>(n) + 0.5L));
    long double slope = 1;
    for (int step = 0; step < 8; ++step) {
      long double before = 1, p = x;
      for (int j = 2; j <= n; ++j) {
        const auto degree = static_cast<long double>(j);
        const long double next = ((2 * degree - 1) * x * p - (degree - 1) * before) / degree;
        before = p;
        p = next;
      }
      slope = static_cast<long double>(n) * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule.node.push_back(static_cast<double>((1 + x) / 2));
    rule.weight.push_back(static_cast<double>(1 / ((1 - x * x) * slope * slope)));
  }
  return rule;
}

}  // namespace

const GaussRule& gauss_rule(int n) {
  static const std::array<GaussRule, kMostNodes + 1> rules = [] {
    std::array<GaussRule, kMostNodes + 1> all;
    for (int i = 1; i <= kMostNodes; ++i) all[static_cast<std::size_t>(i)] = rule_of(i);
    return all;
  }();
  return rules[static_cast<std::size_t>(n)];
}

}  // namespace steradian::exchange
