#include "integrals/ggx/charlie.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/simd.h"
#include "lobes/charlie.h"
#include "render/direct/lobe_packs.h"
#include "steradian/error.h"
#include "steradian/kernels.h"
#include "steradian/ltc.h"
#include "steradian/radiance.h"
#include "support/random_configurations.h"
#include "support/random_squares.h"

namespace steradian::charlie_test {
namespace {

Material charlie(double roughness) {
  Material m;
  m.brdf = Brdf::charlie;
  m.alpha_x = m.alpha_y = std::max(roughness * roughness, 1e-4);
  return m;
}

// Radiance by cubature, in double and in float.
Vec3d sheen_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& m) {
  return radiance(light, at, m, {Method::cubature}).radiance;
}
Vec3d sheen_radiance_float(const PreparedPolygon& light, const ShadingPoint& at, const Material& m) {
  return radiance(light, at, m, {Method::cubature, Quality::normal, Precision::float_}).radiance;
}

}  // namespace

// Unit vectors are unit up to rounding: a cosine one ulp above 1 must not give NaN.
TEST(Sheen, IsANumberWhereTheViewIsTheNormal) {
  const double above = std::nextafter(1.0, 2.0);
  for (double alpha : {0.01, 0.3, 1.0}) {
    const double at_one = lobes::charlie_lobe(alpha, {0, 0, 1}, {0.6, 0, 0.8});
    EXPECT_NEAR(lobes::charlie_lobe(alpha, {0, 0, above}, {0.6, 0, 0.8}), at_one, 1e-12);
    EXPECT_NEAR(lobes::charlie_lobe(alpha, {0.6, 0, 0.8}, {0, 0, above}), lobes::charlie_lobe(alpha, {0.6, 0, 0.8}, {0, 0, 1}), 1e-12);
  }
  reference::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d n = reference::random_direction(random);
    const ShadingPoint at = {{}, n, n};
    const Frame frame = Frame::from_normal(n);
    PolygonLight light;
    for (const Vec3d& v : {Vec3d{1, 0, 1}, Vec3d{0, 0, 1}, Vec3d{0, 1, 1}}) light.vertices.push_back(frame.to_world(v));
    const double radiance = sheen_radiance(prepare_polygon(light), at, charlie(0.6)).x;
    ASSERT_GT(radiance, 0);
    ASSERT_NEAR(reference_radiance(prepare_polygon(light), at, charlie(0.6), {1e-4, 1e-8, 10'000}).radiance.x, radiance, 0.03 * radiance);
  }
}

TEST(Sheen, KernelAndReferenceHaveTheSameLobe) {
  reference::Random random(4);
  Kernels<double> k;
  for (int i = 0; i < 10'000; ++i) {
    const double alpha = random.uniform(0, 1);
    const Vec3d v = reference::random_view(random, {0, 0, 1}), l = reference::random_view(random, {0, 0, 1});
    const double truth = lobes::charlie_lobe(alpha, v, l);
    // The kernel's power by exp and log: 25 times the logarithm's rounding.
    ASSERT_NEAR(k.charlie_lobe(k.charlie_prepare({v.x, v.y, v.z}, alpha), {l.x, l.y, l.z}).v, truth, 1e-12 * truth + 1e-7) << alpha;
  }
}

// Lights of all sizes, roughness and views, within the error that docs/measured/accuracy.md, "Sheen", states for each.
TEST(Sheen, IsWithinThreePercentRms) {
  for (double side : {0.05, 0.5, 2.0, 5.0}) {
    reference::RelativeRms all;
    double worst = 0;
    reference::Random random(5);
    for (double roughness : {0.07, 0.2, 0.4, 0.7, 1.0})
      for (double degrees : {0.0, 45.0, 70.0, 85.0}) {
        reference::RelativeRms cell;
        for (int i = 0; i < 12; ++i) {
          const PreparedPolygon light = reference::random_square(random, side);
          const ShadingPoint at = reference::seen_from(degrees);
          const double truth = reference_radiance(light, at, charlie(roughness), {1e-4, 1e-9, 60'000}).radiance.x;
          const double value = sheen_radiance(light, at, charlie(roughness)).x;
          cell.add(value, truth);
          EXPECT_NEAR(sheen_radiance_float(light, at, charlie(roughness)).x, value, 1e-5 + 1e-4 * value);
        }
        all.add(cell);
        worst = std::max(worst, cell.value());
      }
    std::printf("side %.2f: rms %.4f, worst of 20 cells %.4f\n", side, all.value(), worst);
    EXPECT_LT(all.value(), 0.03) << side;
    EXPECT_LT(worst, side > 2 ? 0.08 : 0.03) << side;
  }
}

TEST(Sheen, IsNeverNegativeAndBelowOneUnderRandomPolygons) {
  reference::Random random(6);
  int lit = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto c = reference::random_configuration(random);
    const double radiance = sheen_radiance(prepare_polygon(c.light), c.at, charlie(random.uniform())).x;
    ASSERT_GE(radiance, 0) << c.kind;
    ASSERT_LT(radiance, 1.1) << c.kind;  // an albedo, with the cubature's error
    lit += radiance > 0;
  }
  EXPECT_GT(lit, 2000);
}

TEST(Sheen, IsRefusedByTheTablesOfGgxAndServesNoOtherLobe) {
  EXPECT_FALSE(serves(LtcMethod::classic, charlie(0.3)));
  EXPECT_FALSE(serves(LtcMethod::compact, charlie(0.3)));
  reference::Random random(7);
  EXPECT_THROW((void)sheen_radiance(reference::random_square(random, 1), reference::seen_from(0), Material{}), Error);
}

TEST(SheenPacks, AgreeWithTheScalarCallsInEveryInstructionSet) {
  reference::Random random(25);
  constexpr std::size_t kCount = 256;
  std::vector<float> a[10];
  for (std::size_t i = 0; i < kCount; ++i) {
    const Vec3d n = normalized(Vec3d{random.uniform(-.5, .5), random.uniform(-.5, .5), 1}), v = reference::random_view(random, n);
    const double values[10] = {random.uniform(-2, 2), random.uniform(-2, 2), 0, n.x, n.y, n.z, v.x, v.y, v.z, random.uniform(0.01, 1)};
    for (std::size_t k = 0; k < 10; ++k) a[k].push_back(static_cast<float>(values[k]));
  }
  PolygonLight panel;  // reaches below the floor
  panel.vertices = {{-0.6, 0.5, -0.4}, {-0.6, 1.1, 1.2}, {1.2, 1.1, 1.2}, {1.2, 0.5, -0.4}};
  panel.two_sided = true;
  const PreparedPolygon light = prepare_polygon(panel);
  const Points points = {kCount,
                         {a[0].data(), a[1].data(), a[2].data()},
                         {a[3].data(), a[4].data(), a[5].data()},
                         {a[6].data(), a[7].data(), a[8].data()},
                         {},
                         a[9].data(),
                         nullptr};
  for (Simd simd : available_simd()) {
    std::vector<float> result(kCount);
    lobe_packs_for(simd)[methods::Procedure::sheen](prepare_light(light), points, {}, {result.data()});
    for (std::size_t i = 0; i < kCount; ++i) {
      Material m = charlie(1);
      m.alpha_x = m.alpha_y = a[9][i];
      const double expected =
          sheen_radiance(light, {{a[0][i], a[1][i], a[2][i]}, {a[3][i], a[4][i], a[5][i]}, {a[6][i], a[7][i], a[8][i]}}, m).x;
      EXPECT_NEAR(result[i], expected, 2e-5 + 1e-4 * expected) << name_of(simd) << " " << i;
    }
  }
}

}  // namespace steradian::charlie_test
