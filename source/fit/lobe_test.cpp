#include "fit/lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "steradian/error.h"
#include "support/chi2.h"

namespace steradian::fit::lobe_test {
namespace {

double albedo(const Lobe& lobe, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3d l = lobe.sample((i + 0.5) / n, (j + 0.5) / n);
      if (l.z > 0) sum += lobe.evaluate(l) / lobe.pdf(l);
    }
  return sum / (n * n);
}

void expect_density_holds(const Lobe& lobe, double width, const std::string& name, double level) {
  reference::Chi2Options options;
  options.axis = normalized(Vec3d{-lobe.view.x, 0, lobe.view.z});
  options.width = width;
  options.samples = 20'000;
  const auto result = reference::chi2_test(lobe.sample, lobe.pdf, options);
  EXPECT_GE(result.p_value, level) << name << ": " << result.evidence;
}

}  // namespace

TEST(Lobes, SamplesHaveTheirDensity) {
  const int tests = 5 * 2 * 2 + 2;
  const double level = reference::sidak_level(1e-3, tests);
  for (const LobeFamily& family : lobe_families())
    for (double roughness : {0.3, 0.8})
      for (double cosine : {0.9, 0.3})
        expect_density_holds(family.at(roughness, cosine), family.frame == LobeFrame::mirror ? 2 * roughness * roughness : 2.0,
                             family.name + " " + std::to_string(roughness) + " " + std::to_string(cosine), level);
  for (double azimuth : {0.3, 2.0}) {
    const Vec3d view = {0.8 * std::cos(azimuth), 0.8 * std::sin(azimuth), 0.6};
    expect_density_holds(ggx_lobe_anisotropic(0.5, 0.15, view), 0.8, "anisotropic", level);
  }
}

// Tests the microfacet lobes only: the authors of the others let them exceed 1 at grazing views.
TEST(Lobes, OfMicrofacetsReflectNoMoreThanArrives) {
  for (const LobeFamily& family : lobe_families()) {
    if (family.frame == LobeFrame::normal) continue;
    for (double roughness : {0.2, 0.5, 1.0})
      for (double cosine : {1.0, 0.7, 0.3, 0.1}) {
        const double a = albedo(family.at(roughness, cosine), 128);
        EXPECT_LE(a, 1.002) << family.name << " " << roughness << " " << cosine;  // the midpoint rule's error
        EXPECT_GT(a, 0.2) << family.name << " " << roughness << " " << cosine;
      }
  }
}

TEST(Lobes, AreReciprocal) {
  for (const LobeFamily& family : lobe_families()) {
    const double c1 = 0.8, c2 = 0.35, roughness = 0.6;
    const Lobe first = family.at(roughness, c1), second = family.at(roughness, c2);
    // Light and view are exchanged: the azimuth between them stays.
    const double phi = 0.7, s1 = std::sqrt(1 - c1 * c1), s2 = std::sqrt(1 - c2 * c2);
    const double there = first.evaluate({s2 * std::cos(phi), s2 * std::sin(phi), c2}) / c2;
    const double back = second.evaluate({s1 * std::cos(phi), s1 * std::sin(phi), c1}) / c1;
    EXPECT_NEAR(there, back, 1e-12) << family.name;
  }
}

TEST(Lobes, AreMirrorSymmetricAndZeroBelowTheHorizon) {
  for (const LobeFamily& family : lobe_families()) {
    const Lobe lobe = family.at(0.5, 0.6);
    for (double a : {0.1, 0.5, 0.9})
      for (double b : {0.05, 0.3, 0.45}) {
        const Vec3d l = lobe.sample(a, b), m = lobe.sample(a, 1 - b);
        EXPECT_NEAR(l.x, m.x, 1e-12) << family.name;
        EXPECT_NEAR(l.y, -m.y, 1e-12) << family.name;
        EXPECT_NEAR(lobe.evaluate(l), lobe.evaluate(m), 1e-12) << family.name;
      }
    EXPECT_EQ(lobe.evaluate(normalized(Vec3d{-0.6, 0, -0.1})), 0) << family.name;
  }
}

TEST(Lobes, RoughOrenNayarScattersBackAndSmoothIsLambert) {
  const Vec3d view = view_from_cosine(0.5);
  const Lobe smooth = oren_nayar_lobe(0, view), rough = oren_nayar_lobe(0.6, view);
  const Vec3d back = view, forth = {-view.x, 0, view.z};
  EXPECT_NEAR(smooth.evaluate(back), 0.5 / std::numbers::pi, 1e-14);
  EXPECT_GT(rough.evaluate(back), 1.2 * rough.evaluate(forth));
}

TEST(Lobes, UnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    lobe_family("plastic");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("disney-diffuse"), std::string::npos) << e.what();
  }
}

}  // namespace steradian::fit::lobe_test
