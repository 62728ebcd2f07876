// Albedos and multiple scattering, by table or by few nodes, against plain quadrature of the reference's lobes.
#include "steradian/albedo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lobes/lobe.h"
#include "steradian/closed_form.h"
#include "steradian/ltc.h"
#include "steradian/reference.h"

namespace steradian::albedo_test {
namespace {

Material ggx(double alpha_x, double alpha_y) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = alpha_x;
  m.alpha_y = alpha_y;
  m.tangent = {1, 0, 0};
  return m;
}

Material charlie(double alpha) {
  Material m;
  m.brdf = Brdf::charlie;
  m.alpha_x = m.alpha_y = alpha;
  return m;
}

Vec3d view_at(double cosine, double phi = 0) {
  const double s = std::sqrt(1 - cosine * cosine);
  return {s * std::cos(phi), s * std::sin(phi), cosine};
}

// Quadrature over the lobe's own samples, n x n midpoints.
double albedo_by_quadrature(const Material& m, Vec3d view, int n) {
  const lobes::Lobe lobe(m, view);
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3d l = lobe.sample((i + 0.5) / n, (j + 0.5) / n);
      const double pdf = lobe.pdf(l);
      if (l.z > 0 && pdf > 0) sum += lobe.evaluate(l).plain / pdf;
    }
  return sum / (n * n);
}

PreparedPolygon lamp() {
  return prepare_polygon({{{-1.5, -0.6, 1}, {-1, -0.6, 1.4}, {-1, 0.6, 1.4}, {-1.5, 0.6, 1}}, {}, {3, 2, 1}, true});
}

}  // namespace

TEST(Albedo, OfGgxIsNearQuadrature) {
  double rough = 0, smooth = 0;
  for (double r = 0.05; r < 1.001; r += 0.05)
    for (double c : {1.0, 0.8, 0.5, 0.3, 0.2, 0.1, 0.05}) {
      const Material m = ggx(r * r, r * r);
      const double error = std::fabs(ggx_albedo(m, {{}, {0, 0, 1}, view_at(c)}) / albedo_by_quadrature(m, view_at(c), 200) - 1);
      double& worst = r > 0.29 ? rough : smooth;
      worst = std::max(worst, error);
    }
  // These bounds on the table are stated in docs/theory/ltc.md.
  EXPECT_LT(rough, 0.02);
  EXPECT_LT(smooth, 0.045);
  RecordProperty("rough", std::to_string(rough));
  RecordProperty("smooth", std::to_string(smooth));
  std::printf("albedo by the table, relative error: %.4f at roughness 0.3 and more, %.4f below\n", rough, smooth);
}

TEST(Albedo, OfAnisotropicGgxIsNearQuadrature) {
  double worst = 0;
  for (double ax : {0.05, 0.2, 0.5, 1.0})
    for (double ay : {0.02, 0.1, 0.4})
      for (double phi : {0.0, 0.5, 1.0, 1.57})
        for (double c : {1.0, 0.7, 0.4, 0.2, 0.1}) {
          const Material m = ggx(ax, ay);
          const Vec3d v = view_at(c, phi);
          worst = std::max(worst, std::fabs(ggx_albedo(m, {{}, {0, 0, 1}, v}) / albedo_by_quadrature(m, v, 200) - 1));
        }
  EXPECT_LT(worst, 0.02);
  std::printf("albedo by 128 nodes, anisotropic: relative error %.4f\n", worst);
}

TEST(Albedo, OfCharlieIsNearQuadratureAndBelowOne) {
  double worst = 0;
  for (double r = 0.2; r < 1.001; r += 0.1)
    for (double c : {1.0, 0.8, 0.5, 0.3, 0.1}) {
      const double q = albedo_by_quadrature(charlie(r * r), view_at(c), 300);
      worst = std::max(worst, std::fabs(charlie_albedo(r * r, c) - q));
      EXPECT_LT(q, 1) << r << " " << c;
    }
  EXPECT_LT(worst, 0.02);  // as stated in docs/theory/ltc.md
  std::printf("albedo of charlie by its table: error %.4f\n", worst);
}

// In a white furnace, a facet of F = 1 is white.
TEST(MultipleScattering, ReturnsWhatOneBounceLoses) {
  for (double alpha : {0.1, 0.3, 0.6, 1.0})
    for (double c : {1.0, 0.5, 0.2}) {
      Material m = ggx(alpha, alpha);
      const double one = albedo_by_quadrature(m, view_at(c), 200);
      m.multiple_scattering = true;
      const Material all = with_multiple_scattering(m, {{}, {0, 0, 1}, view_at(c)});
      EXPECT_FALSE(all.multiple_scattering);
      EXPECT_NEAR(one * all.f0.x, 1, 0.02) << alpha << " " << c;
    }
}

TEST(MultipleScattering, IsTheSameFactorForEveryMethod) {
  const ShadingPoint at = {{}, {0, 0, 1}, view_at(0.6)};
  Material one = ggx(0.5, 0.5);
  one.f0 = {0.9, 0.5, 0.04};
  Material all = one;
  all.multiple_scattering = true;
  const Material scaled = with_multiple_scattering(all, at);
  EXPECT_GT(scaled.f0.x / one.f0.x, 1.1);
  const auto expect_same = [](Vec3d a, Vec3d b) {
    EXPECT_NEAR(a.x, b.x, 1e-12 * b.x);
    EXPECT_NEAR(a.y, b.y, 1e-12 * b.y);
    EXPECT_NEAR(a.z, b.z, 1e-12 * b.z);
  };
  expect_same(closed_form_radiance(lamp(), at, all), closed_form_radiance(lamp(), at, scaled));
  expect_same(ltc_radiance(LtcMethod::classic, lamp(), at, all), ltc_radiance(LtcMethod::classic, lamp(), at, scaled));
  expect_same(reference_radiance(lamp(), at, all).radiance, reference_radiance(lamp(), at, scaled).radiance);
}

// One bounce reflects more than a quarter for all widths and views, so F0 = 1 grows to less than four times itself.
TEST(MultipleScattering, StaysInBoundsAtGrazingViews) {
  for (double ax : {1e-4, 0.1, 1.0})
    for (double ay : {1e-4, 0.3, 1.0})
      for (double c : {1e-7, 1e-4, 0.01, 0.05}) {
        Material m = ggx(ax, ay);
        m.multiple_scattering = true;
        const Material all = with_multiple_scattering(m, {{}, {0, 0, 1}, view_at(c, 0.7)});
        EXPECT_GE(all.f0.x, 1) << ax << " " << ay << " " << c;
        EXPECT_LT(all.f0.x, 4) << ax << " " << ay << " " << c;
      }
}

}  // namespace steradian::albedo_test
