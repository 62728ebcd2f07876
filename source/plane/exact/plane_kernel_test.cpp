// Closed forms of kernels/plane/plane.glsl against quadrature.
#include <gtest/gtest.h>

#include <cmath>

#include "plane/exact/random.h"
#include "steradian/kernels.h"

namespace steradian::plane::plane_kernel_test {
namespace {

// The window (1 - r^2)^2 over the near side of a disk, between two slopes within its tangents: Simpson's rule.
double window_by_quadrature(double m0, double m1, double d2, double rho2) {
  const double from = std::atan(m0), to = std::atan(m1);
  const auto f = [&](double psi) {
    const double s = std::sin(psi), r = std::sqrt(d2) * std::cos(psi) - std::sqrt(rho2 - d2 * s * s);
    return (1 - r * r) * (1 - r * r);
  };
  constexpr int kPieces = 4000;
  const double h = (to - from) / kPieces;
  double sum = f(from) + f(to);
  for (int i = 1; i < kPieces; ++i) sum += (i % 2 == 0 ? 2 : 4) * f(from + h * i);
  return sum * h / 3;
}

}  // namespace

TEST(PlaneKernels, DiskWindowAgreesWithQuadrature) {
  SceneRandom random(5);
  Kernels<double> kernel;
  double worst = 0, worst_whole = 0;
  for (int i = 0; i < 300; ++i) {
    const double d2 = random.uniform(0.02, 0.9), rho2 = d2 * random.uniform(1e-3, 0.9);
    const double tangent = std::sqrt(rho2 / (d2 - rho2)), m0 = random.uniform(-0.9, 0) * tangent, m1 = random.uniform(0, 0.9) * tangent;
    // Simpson's error is of the order h^4 of a fourth derivative that grows as the tangent nears: below 1e-9 at 0.9.
    const double between = (kernel.plane_disk_window(m1, d2, rho2) - kernel.plane_disk_window(m0, d2, rho2)).v;
    worst = std::max(worst, std::fabs(between - window_by_quadrature(m0, m1, d2, rho2)));
    worst_whole = std::max(
        worst_whole, std::fabs((kernel.plane_disk_window_whole(tangent, d2, rho2) - 2.0 * kernel.plane_disk_window(tangent, d2, rho2)).v));
  }
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(worst_whole, 1e-13);  // a few dozen roundings of sums of order 1
}

}  // namespace steradian::plane::plane_kernel_test
