// Complex numbers, Gauss and Legendre's rules, and the start of the quartic's roots.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/random.h"
#include "steradian/kernels.h"

namespace steradian::quartic_test {
namespace {

using K = Kernels<double>;
using KF = Kernels<float>;
using reference::Random;

}  // namespace

TEST(Complex, UnitIsCosineAndSine) {
  K k;
  KF f;
  double worst = 0, worst_float = 0;
  for (int i = -1000; i <= 1000; ++i) {
    const double x = i * std::numbers::pi / 1000;
    const auto u = k.complex_unit(x);
    const auto uf = f.complex_unit(x);
    worst = std::max({worst, std::fabs(u.x.v - std::cos(x)), std::fabs(u.y.v - std::sin(x))});
    worst_float =
        std::max({worst_float, std::fabs(static_cast<double>(uf.x.v) - std::cos(x)), std::fabs(static_cast<double>(uf.y.v) - std::sin(x))});
  }
  EXPECT_LT(worst, 8 * 1.1e-16);       // 8 roundings
  EXPECT_LT(worst_float, 8 * 6.0e-8);  // of either kind
}

TEST(Complex, QuotientUndoesProduct) {
  K k;
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const K::vec2 a(random.uniform(-1, 1), random.uniform(-1, 1)), b(random.uniform(-1, 1), random.uniform(0.1, 1));
    const auto c = k.complex_quotient(k.complex_product(a, b), b);
    EXPECT_NEAR(c.x.v, a.x.v, 1e-14);  // |b| > 0.1: a few roundings times 10
    EXPECT_NEAR(c.y.v, a.y.v, 1e-14);
  }
}

TEST(GaussLegendre, IntegratesPolynomialsOfItsDegreesExactly) {
  K k;
  for (int n : {1, 2, 3, 4, 5, 6, 8})
    for (int degree = 0; degree < 2 * n; ++degree) {
      double sum = 0;
      for (int j = 0; j < n; ++j) {
        const auto node = k.gauss_legendre_node(n, j);
        sum += node.y.v * std::pow(node.x.v, degree);
      }
      EXPECT_NEAR(sum, 1.0 / (degree + 1), 1e-15) << n << " nodes, degree " << degree;
    }
}

TEST(Quartic, CosineOfTheThirdOfAnAngle) {
  K k;
  double worst = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double x = i / 50000.0 - 1;
    worst = std::max(worst, std::fabs(k.quartic_third_cosine(x).v - std::cos(std::acos(x) / 3)));
  }
  EXPECT_LT(worst, 1e-7);
  std::printf("largest error %.2e\n", worst);
}

TEST(Quartic, StartsAtTheRootsUnlessPairsNearlyMeet) {
  K k;
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::complex<double> a(random.uniform(-1, 1), random.uniform(0.05, 1)), b(random.uniform(-1, 1), random.uniform(0.05, 1));
    if (std::abs(a - b) < 0.1) continue;
    const double sa = -2 * a.real(), ta = std::norm(a), sb = -2 * b.real(), tb = std::norm(b);
    const auto z = k.quartic_poles_approximate(ta * tb, sa * tb + sb * ta, ta + tb + sa * sb, sa + sb);
    const std::complex<double> z1(z.z1.x.v, z.z1.y.v), z2(z.z2.x.v, z.z2.y.v);
    worst = std::max(worst, std::min(std::abs(z1 - a) + std::abs(z2 - b), std::abs(z1 - b) + std::abs(z2 - a)));
  }
  // The cosine has an error of 1e-7. Squares of heights and distances magnify it by at most 1 / 0.05 and 1 / 0.1, and roots of vanishing
  // quantities take the root of that.
  EXPECT_LT(worst, 1e-2);
  std::printf("largest distance %.2e\n", worst);
}

}  // namespace steradian::quartic_test
