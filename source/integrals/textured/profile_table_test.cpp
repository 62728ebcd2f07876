// The table of a profile against the profile itself.
#include "integrals/textured/profile_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "core/random.h"
#include "integrals/textured/profiled_light.h"

namespace steradian::profile_table_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Bright at 40 degrees, and more along one plane; planes by `step` degrees, or one for all around.
LightProfile lamp(double step, double last = 90) {
  LightProfile p;
  for (double v = 0; v <= last; v += 5) p.vertical.push_back(v);
  if (step > 0)
    for (double h = 0; h <= 360; h += step) p.horizontal.push_back(h);
  else
    p.horizontal = {0};
  for (const double h : p.horizontal)
    for (const double v : p.vertical)
      p.candela.push_back(10 + 20 * std::exp(-(v - 40) * (v - 40) / 300) * (1 + 0.5 * std::cos(2 * h * kDegree)));
  return p;
}

// Intensity by t = sin(theta / 2) and the horizontal angle.
double candela_at(const LightProfile& p, double t, double around) {
  const double theta = 2 * std::asin(std::min(std::fabs(t), 1.0));
  return intensity(p, {std::sin(theta) * std::cos(around), std::sin(theta) * std::sin(around), std::cos(theta)});
}

// A step is linear in t, and the profile in theta. At a kink they differ by at most a quarter of a step times the change of slope, over one
// step of the interval. The slope is at most 30 candela in 5 degrees of theta, which are half as much of t.
TEST(ProfileTable, MeansAreThoseOfTheProfile) {
  reference::Random random(5);
  for (const double planes : {0.0, 30.0})
    for (const double last : {90.0, 180.0}) {
      const LightProfile profile = lamp(planes, last);
      const ProfileTable table(profile);
      ASSERT_TRUE(table.serves());
      EXPECT_EQ(table.columns(), planes > 0 ? 12 : 1);
      const double kink = 0.25 * static_cast<double>(table.step()) * 2 * (2 * 30 / (5 * kDegree));
      double worst = 0;
      for (int i = 0; i < 400; ++i) {
        const double half = 0.01 + 0.1 * random.uniform(), t = random.uniform() * static_cast<double>(table.last());
        const int column = static_cast<int>(random.uniform() * table.columns());
        const double around = 2 * std::numbers::pi * column / table.columns();
        double sum = 0;
        constexpr int kPoints = 4000;
        for (int k = 0; k < kPoints; ++k) {
          const double at = t + half * ((2 * k + 1.0) / kPoints - 1);
          if (std::fabs(at) <= static_cast<double>(table.last())) sum += candela_at(profile, at, around);
        }
        worst = std::max(worst, std::fabs(table.mean(t, half, column) - sum / kPoints));
      }
      const double allowed = kink * static_cast<double>(table.step()) / 0.02 + 40.0 / 4000;  // and the end of the sum of points
      std::printf("planes by %.0f degrees, to %.0f: worst %.2e of at most 40 candela, allowed %.2e\n", planes, last, worst, allowed);
      EXPECT_LT(worst, allowed);
    }
}

TEST(ProfileTable, DimPartsKeepTheirDigits) {
  LightProfile p;
  for (double v = 0; v <= 90; v += 5) p.vertical.push_back(v), p.candela.push_back(std::exp2(-v * v / 144));
  p.horizontal = {0};
  const ProfileTable table(p);
  for (const double v : {42.5, 57.5, 72.5}) {
    const double t = std::sin(v * kDegree / 2), want = candela_at(p, t, 0);
    EXPECT_NEAR(table.mean(t, static_cast<double>(table.least_half()), 0), want, 1e-3 * want) << v << " degrees: " << want;
  }
}

TEST(ProfileTable, TypeBAndUnequalPlanesHaveNone) {
  LightProfile p = lamp(30);
  p.horizontal[1] = 31.4159;
  EXPECT_FALSE(ProfileTable(p).serves());
  p = lamp(30);
  p.type = LightProfile::Type::b;
  EXPECT_FALSE(ProfileTable(p).serves());
}

// If one value serves for the whole light, the radiance of every place is within kEven of it. Some points have one.
TEST(ProfileTable, AnEvenLightIsEvenInEveryPlace) {
  // A spot: cosine to 20 degrees, nothing from 22 on.
  const auto spot = std::make_shared<LightProfile>();
  spot->horizontal = {0};
  for (double v = 0; v <= 22.5; v += 0.1) {
    spot->vertical.push_back(v);
    spot->candela.push_back(std::cos(v * kDegree) * std::clamp((22 - v) / 2, 0.0, 1.0));
  }
  reference::Random random(6);
  for (const bool round : {false, true}) {
    AreaLight light;
    if (round)
      light.shape = Ellipse{{0, 2, 0}, {0.2, 0, 0}, {0, 0, 0.1}};
    else
      light.shape = Polygon{{{-0.2, 2, -0.1}, {0.2, 2, -0.1}, {0.2, 2, 0.1}, {-0.2, 2, 0.1}}, {}};
    set_emission(light, spot, {1, 0, 0}, {1, 1, 1});
    const ProfiledLight lamp(light, std::make_shared<const ProfileTable>(*spot));
    const auto outline = lamp.outline();
    int bright = 0, dark = 0, other = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3d position = {3 * random.uniform() - 1.5, 0.5 * random.uniform(), 3 * random.uniform() - 1.5};
      const std::optional<Vec3d> even = lamp.even_radiance(position);
      if (!even) {
        ++other;
        continue;
      }
      ++(even->x > 0 ? bright : dark);
      for (int k = 0; k < 20; ++k) {
        const double u = 2 * random.uniform() - 1, v = 2 * random.uniform() - 1;
        if (round && u * u + v * v > 1) continue;
        const Vec3d place = outline.center + outline.x * u + outline.y * v;
        EXPECT_NEAR(emitted_radiance(lamp.emission(), normalized(position - place)).x, even->x,
                    (static_cast<double>(ProfiledLight::kEven) + 1e-5) * even->x)
            << position.x << " " << position.y << " " << position.z;
      }
    }
    EXPECT_GT(bright, 100);
    EXPECT_GT(dark, 100);
    EXPECT_GT(other, 100);
  }
}

}  // namespace
}  // namespace steradian::profile_table_test
