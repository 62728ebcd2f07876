// Test support for a sampler's density: Pearson's chi-square test over cells of the sphere.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "steradian/vector.h"

namespace steradian::reference {

// Q(a, x) = Gamma(a, x) / Gamma(a), a > 0, x >= 0. Relative error about 1e-14 times the square root of a.
double regularized_upper_gamma(double a, double x);

// Probability of a chi-square above `statistic` for so many degrees of freedom.
double chi2_p_value(double statistic, int freedom);

// Level of each of `tests` independent tests that together may fail by chance once in 1 / significance. Source: Sidak 1967.
double sidak_level(double significance, int tests);

struct Chi2Options {
  Vec3d axis{0, 0, 1};  // the cells' pole
  double width = 2;     // half of the cells' rings lie within this angle [rad] of the pole: the narrow lobe's width
  int rings = 12;
  int columns = 24;
  int samples = 100'000;
  std::uint64_t seed = 1;
};

struct Chi2Result {
  double p_value = 0;
  double statistic = 0;
  int freedom = 0;
  double expected_total = 0;  // the density's integral: 1, or less if the sampler may return the zero vector
  std::string evidence;       // the above and the worst cells, for a failing test
};

// Draws from sample(u, v), counts by cell, and compares with the density's integral over each cell. Cells that expect fewer than 5 are
// pooled. The zero vector counts as a cell of its own, which expects 1 minus the density's integral.
Chi2Result chi2_test(const std::function<Vec3d(double, double)>& sample, const std::function<double(Vec3d)>& pdf,
                     const Chi2Options& options);

}  // namespace steradian::reference
