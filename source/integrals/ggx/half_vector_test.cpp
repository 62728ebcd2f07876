// Edge splitting in half vector space against the reference, pole-mapped and uniform.
#include "steradian/half_vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "steradian/closed_form.h"
#include "steradian/error.h"
#include "support/random_configurations.h"
#include "support/random_rectangles.h"

namespace steradian::half_vector_test {
namespace {

using ggx::random_rectangle;
using reference::Random;

struct Case {
  PreparedPolygon light;
  ShadingPoint at;
  Material material;
  double truth;
};

// Rectangles near the mirror direction for widths 0.05 to 0.8; Blinn-Phong's exponent is that of the width.
std::vector<Case> cases(Brdf brdf, double view, int per_alpha) {
  Random random(static_cast<std::uint64_t>(100 * view) + static_cast<std::uint64_t>(brdf));
  std::vector<Case> result;
  for (double alpha : {0.05, 0.1, 0.2, 0.4, 0.8})
    for (int i = 0; i < per_alpha; ++i) {
      auto s = random_rectangle(random, std::sqrt(alpha), view);
      s.material.brdf = brdf;
      s.material.exponent = 2 / (alpha * alpha) - 2;
      s.material.shadowing = false;
      Case c{prepare_polygon(s.light), s.at, s.material, 0};
      c.truth = reference_radiance(c.light, c.at, c.material, {1e-6, 1e-8, 100'000}).radiance.x;
      result.push_back(c);
    }
  return result;
}

struct Deviation {
  double rms, largest;
};
Deviation error_of(const std::vector<Case>& all, const HalfVectorOptions& options) {
  Deviation e{0, 0};
  for (const Case& c : all) {
    const double d = std::fabs(half_vector_radiance(c.light, c.at, c.material, options).x - c.truth);
    e.rms += d * d;
    e.largest = std::max(e.largest, d);
  }
  e.rms = std::sqrt(e.rms / static_cast<double>(all.size()));
  return e;
}

}  // namespace

class HalfVector : public testing::TestWithParam<Brdf> {};
INSTANTIATE_TEST_SUITE_P(Lobes, HalfVector, testing::Values(Brdf::blinn_phong, Brdf::beckmann, Brdf::ggx));

TEST_P(HalfVector, FourPoleMappedArcsHoldTheirError) {
  for (double view : {5.0, 45.0, 75.0, 85.0}) {
    const auto all = cases(GetParam(), view, 30);
    for (int arcs : {1, 2, 3, 4, 6, 8}) {
      const Deviation pole = error_of(all, {arcs, ArcSplit::pole_mapped}), uniform = error_of(all, {arcs, ArcSplit::uniform});
      std::printf("view %2.0f, %d arcs: pole-mapped rms %.5f largest %.4f, uniform rms %.5f largest %.4f\n", view, arcs, pole.rms,
                  pole.largest, uniform.rms, uniform.largest);
      // A great circle alone has an error of 2e-3 to 2e-2 (mean square). Four nodes of the area between leave a tenth at least, and
      // Beckmann's series 5e-5 for each half edge.
      if (arcs == 4) {
        EXPECT_LE(pole.rms, view > 80 ? 1e-3 : 3e-4) << "view " << view;
        if (view >= 75) {
          EXPECT_GE(uniform.rms, 2 * pole.rms) << "view " << view;
        }
      }
    }
  }
}

TEST_P(HalfVector, ManyArcsConvergeToTheReference) {
  for (double view : {5.0, 45.0, 75.0}) {
    const auto all = cases(GetParam(), view, 4);
    const Deviation e = error_of(all, {200, ArcSplit::pole_mapped});
    // The error of chords falls with the square of their number, 2500 times from 4 to 200; Beckmann retains the series' 5e-5 a half edge.
    EXPECT_LE(e.largest, GetParam() == Brdf::beckmann ? 4 * 2 * 5.5e-5 : 5e-5) << "view " << view;
    std::printf("view %2.0f: largest error of 200 arcs %.2e\n", view, e.largest);
  }
}

// A light that fills the upper half space, one seen edge-on, and a wall that stands on the surface beside the point; every lobe, every
// view.
TEST_P(HalfVector, HoldsItsErrorOverWhateverFillsTheHemisphereOrIsSeenEdgeOn) {
  Random random(17);
  double worst = 0, error = 0, signal = 0;
  for (int i = 0; i < 120; ++i) {
    const double view = std::vector<double>{0, 30, 60, 75, 85}[static_cast<std::size_t>(i) % 5] * ggx::kRadians;
    const double turn = random.uniform(-std::numbers::pi, std::numbers::pi), alpha = std::exp(random.uniform(std::log(0.01), 0.0));
    Material m;
    m.brdf = GetParam();
    m.alpha_x = m.alpha_y = alpha;
    m.exponent = 2 / (alpha * alpha) - 2;
    m.shadowing = false;
    const ShadingPoint at = {{}, {0, 0, 1}, {std::sin(view) * std::cos(turn), std::sin(view) * std::sin(turn), std::cos(view)}};
    const double gap = std::pow(10.0, random.uniform(-5, -1)), aside = random.uniform(-0.7, 0.7);
    PolygonLight light;
    light.two_sided = true;
    switch (i % 3) {
      case 0: light.vertices = {{-1, -1, gap}, {1, -1, gap}, {1, 1, gap}, {-1, 1, gap}}; break;
      case 1: light.vertices = {{-1, gap, 0.2}, {1, gap, 0.2}, {1, gap, 1.2}, {-1, gap, 1.2}}; break;
      default: light.vertices = {{aside - 1, gap, -1}, {aside + 1, gap, -1}, {aside + 1, gap, 1}, {aside - 1, gap, 1}};
    }
    const PreparedPolygon prepared = prepare_polygon(light);
    const double truth = reference_radiance(prepared, at, m, {1e-6, 1e-8, 100'000}).radiance.x;
    const double d = std::fabs(half_vector_radiance(prepared, at, m).x - truth);
    worst = std::max(worst, d / std::max(truth, 1.0));
    error += d * d;
    signal += truth * truth;
  }
  std::printf("relative rms error %.1e, largest %.1e of the lobe\n", std::sqrt(error / signal), worst);
  EXPECT_LE(std::sqrt(error / signal), 3e-4);
  EXPECT_LE(worst, 2e-3);
}

// Shadowing and Fresnel come from the closed form's cubature; only the measure comes from the arcs: relative RMSE as without.
TEST(HalfVectorGgx, ShadowingAndFresnelAreAveraged) {
  for (const double f0 : {1.0, 0.04})
    for (const double view : {5.0, 45.0, 75.0}) {
      Random random(static_cast<std::uint64_t>(view));
      double error = 0, signal = 0;
      for (const double alpha : {0.05, 0.1, 0.2, 0.4, 0.8})
        for (int i = 0; i < 12; ++i) {
          auto s = random_rectangle(random, std::sqrt(alpha), view);
          s.material.f0 = {f0, f0, f0};
          const PreparedPolygon light = prepare_polygon(s.light);
          const double truth = reference_radiance(light, s.at, s.material, {1e-6, 1e-8, 100'000}).radiance.x;
          const double d = half_vector_radiance(light, s.at, s.material, {}).x - truth;
          error += d * d;
          signal += truth * truth;
        }
      const double relative = std::sqrt(error / signal);
      EXPECT_LT(relative, 0.006) << "f0 " << f0 << " view " << view;
      std::printf("f0 %.2f view %2.0f: relative RMSE %.4f\n", f0, view, relative);
    }
}

// A needle in the lobe: one edge's chords omit the area that the other's must omit as well.
TEST(HalfVectorGgx, AThinLightIsWhatItsTwoEdgesLeave) {
  for (const Brdf brdf : {Brdf::ggx, Brdf::blinn_phong, Brdf::beckmann})
    for (const double width : {1e-2, 1e-3, 1e-4}) {
      PolygonLight strip;  // across the mirror direction, seen from the front
      const Vec3d center{-0.7, 0.1, 0.7}, along = normalized(Vec3d{0.3, 1, 0.2}), normal = normalized(Vec3d{0.7, -0.1, -0.6});
      const Vec3d x = normalized(along - normal * dot(along, normal)), y = cross(normal, x) * width;
      strip.vertices = {center - x - y, center + x - y, center + x + y, center - x + y};
      const PreparedPolygon light = prepare_polygon(strip);
      const ShadingPoint at = {{}, {0, 0, 1}, normalized(Vec3d{0.7, 0, 0.7})};
      Material m;
      m.brdf = brdf;
      m.exponent = 200;
      m.alpha_x = m.alpha_y = 0.1;
      const double truth = reference_radiance(light, at, m).radiance.x;
      EXPECT_NEAR(half_vector_radiance(light, at, m, {}).x / truth, 1, 0.005) << name_of(brdf) << " " << width;
      EXPECT_NEAR(half_vector_radiance_float(light, at, m, {}).x / truth, 1, 0.005 + 1e-4 / width) << name_of(brdf) << " " << width;
    }
}

TEST_P(HalfVector, FloatFollowsDouble) {
  double worst = 0;
  for (double view : {5.0, 45.0, 75.0})
    for (const Case& c : cases(GetParam(), view, 20)) {
      const double value = half_vector_radiance(c.light, c.at, c.material).x;
      worst = std::max(worst, std::fabs(half_vector_radiance_float(c.light, c.at, c.material).x - value));
    }
  // Blinn-Phong's series: 2e-4 of the lobe for each side of the foot, on 4 edges.
  EXPECT_LE(worst, 4 * 2 * 2.2e-4);
  std::printf("largest difference %.2e\n", worst);
}

TEST(HalfVectorLobes, TakeEveryExponentAndAnisotropy) {
  Random random(3);
  double worst_low = 0, worst_beckmann = 0;
  for (int i = 0; i < 60; ++i) {
    auto s = random_rectangle(random, 0.9, random.uniform(5, 70));
    const PreparedPolygon light = prepare_polygon(s.light);
    s.material.brdf = Brdf::blinn_phong;
    s.material.exponent = random.uniform(0, 3);
    const auto difference = [&] {
      return std::fabs(half_vector_radiance(light, s.at, s.material, {64}).x -
                       reference_radiance(light, s.at, s.material, {1e-6, 1e-8, 100'000}).radiance.x);
    };
    worst_low = std::max(worst_low, difference());
    s.material.brdf = Brdf::beckmann;
    s.material.alpha_x = random.uniform(0.05, 0.8);
    s.material.alpha_y = random.uniform(0.05, 0.8);
    s.material.tangent = reference::random_direction(random);
    worst_beckmann = std::max(worst_beckmann, difference());
  }
  EXPECT_LE(worst_low, 5e-4);
  EXPECT_LE(worst_beckmann, 5e-4 + 4 * 2 * 5.5e-5);
  std::printf("largest error: exponents 0 to 3 %.2e, anisotropic Beckmann %.2e\n", worst_low, worst_beckmann);
}

TEST(HalfVectorLobes, AreFiniteForNonsense) {
  Random random(4);
  for (int i = 0; i < 20'000; ++i) {
    const auto c = reference::random_configuration(random);
    Material m = reference::random_material(random);
    if (m.brdf == Brdf::lambert || m.brdf == Brdf::phong) continue;
    m.exponent = std::pow(10.0, random.uniform(-1, 8));
    ShadingPoint at = c.at;
    const double z = std::pow(10.0, random.uniform(-4, 0));
    at.view = Frame::from_normal(at.normal).to_world({std::sqrt(1 - z * z), 0, z});
    const PreparedPolygon light = prepare_polygon(c.light);
    const double value = half_vector_radiance(light, at, m).x, value_float = half_vector_radiance_float(light, at, m).x;
    ASSERT_TRUE(std::isfinite(value) && value >= 0 && std::isfinite(value_float) && value_float >= 0)
        << i << ": " << reference::describe(c, m) << " view " << z << ": " << value << " " << value_float;
  }
}

TEST(HalfVectorLobes, RefuseWhatTheyDoNotHave) {
  const auto light = prepare_polygon({{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}, {}, {1, 1, 1}, false});
  const ShadingPoint at{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  Material m;
  EXPECT_THROW(half_vector_radiance(light, at, m), steradian::Error);
  m.brdf = Brdf::beckmann;
  EXPECT_THROW(half_vector_radiance(light, at, m, {0}), steradian::Error);
}

}  // namespace steradian::half_vector_test
