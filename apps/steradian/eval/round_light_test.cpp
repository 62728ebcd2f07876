// Round lights in `steradian eval`: form factors against closed forms, every lobe against the reference, degenerate cases.
#include "integrals/curved_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "eval/answer.h"
#include "support/random_configurations.h"

namespace steradian::eval::round_light_test {
namespace {

using reference::Random;
using reference::random_direction;

AreaLight sphere(Vec3d center, double radius) { return {Ellipsoid{center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}; }
AreaLight disk(Vec3d center, Vec3d x, Vec3d y) { return {Ellipse{center, x, y}}; }

Material material_of(Brdf brdf) {
  Material m;
  m.brdf = brdf;
  return m;
}
Material ggx(double alpha) {
  Material m = material_of(Brdf::ggx);
  m.alpha_x = m.alpha_y = alpha;
  return m;
}

Answer ask(const AreaLight& light, const ShadingPoint& at, const Material& m, Method method = Method::automatic,
           Quality quality = Quality::normal) {
  Query q;
  q.lights = {light};
  q.position = at.position;
  q.normal = at.normal;
  q.view = at.view;
  q.materials = {m};
  q.method = method;
  q.quality = quality;
  return evaluate(q);
}

const ShadingPoint kFloor{{}, {0, 1, 0}, normalized(Vec3d{0.3, 1, 0})};

}  // namespace

TEST(EvalRoundLight, LambertIsTheFormFactor) {
  const Material lambert = material_of(Brdf::lambert);
  // A sphere above the horizon: (R/d)^2 cos. A disk on the axis: R^2 / (R^2 + d^2).
  EXPECT_NEAR(ask(sphere({1, 2, 2}, 0.5), kFloor, lambert).radiance.x, 0.25 / 9 * 2 / 3, 1e-14);
  EXPECT_NEAR(ask(disk({0, 2, 0}, {1, 0, 0}, {0, 0, 1}), kFloor, lambert).radiance.x, 0.2, 1e-14);
  // Half of an upright sphere's cone is above the horizon: Cohen and Wallace's clipped sphere, by the reference.
  const Answer cut = ask(sphere({1, 0, 0}, 0.5), kFloor, lambert);
  const Answer truth = ask(sphere({1, 0, 0}, 0.5), kFloor, lambert, Method::reference);
  EXPECT_NEAR(cut.radiance.x, truth.radiance.x, *truth.bound);
  EXPECT_GT(cut.radiance.x, 0.01);
}

TEST(EvalRoundLight, EveryLobeAgreesWithTheReference) {
  struct Case {
    const char* name;
    Material material;
    Method method;
    Quality quality;
    double
        error;  // error of the method on polygons (docs/measured/accuracy.md, docs/theory/moments.md) plus 0.0011 for K = 12, 0.003 for GGX
  };
  Material phong = material_of(Brdf::phong), sharp = phong, blinn = material_of(Brdf::blinn_phong);
  phong.exponent = 10;
  sharp.exponent = 1000;
  blinn.exponent = 100;
  Material bare = ggx(0.1);
  bare.shadowing = false;
  Material beckmann = ggx(0.2);
  beckmann.brdf = Brdf::beckmann;
  const Case cases[] = {{"phong 10", phong, Method::automatic, Quality::normal, 1.3e-3 + 1.1e-3},
                        {"phong 1000", sharp, Method::automatic, Quality::high, 4.5e-4 + 1.1e-3},
                        {"phong exact", sharp, Method::exact, Quality::normal, 1e-10},
                        {"ggx", ggx(0.4), Method::automatic, Quality::normal, 0.005 + 0.003},
                        {"ggx high", ggx(0.1), Method::automatic, Quality::high, 0.002 + 0.003},
                        {"ggx draft", ggx(0.3), Method::automatic, Quality::draft, 0.05},
                        {"ggx exact", bare, Method::exact, Quality::normal, 1e-6},
                        {"blinn-phong", blinn, Method::automatic, Quality::normal, 0.01 + 0.003},
                        {"beckmann", beckmann, Method::automatic, Quality::high, 0.003 + 0.003}};
  for (const Case& c : cases) {
    Random random(7);
    double worst = 0, largest = 0, bound = 0;
    for (int i = 0; i < 3; ++i) {
      Vec3d direction = random_direction(random);
      direction.y = std::fabs(direction.y);
      const double size = random.uniform(0.1, 0.6);
      AreaLight light = sphere(direction, size);
      if (i % 3 == 1) std::get<Ellipsoid>(light.shape).z *= 0.4;
      if (i % 3 == 2) {
        light = disk(direction, {size, 0, 0}, Vec3d{0.2, 0.3, 0.9} * size);
        light.two_sided = true;
      }
      const Vec3d mirror = normalized(direction + random_direction(random) * 0.3 + Vec3d{0, 0.3, 0});
      const ShadingPoint at = {{}, {0, 1, 0}, {-mirror.x, std::max(mirror.y, 0.1), -mirror.z}};
      const ShadingPoint unit = {at.position, at.normal, normalized(at.view)};
      const Answer truth = ask(light, unit, c.material, Method::reference);
      worst = std::max(worst, std::fabs(ask(light, unit, c.material, c.method, c.quality).radiance.x - truth.radiance.x));
      largest = std::max(largest, truth.radiance.x);
      bound = std::max(bound, *truth.bound);
    }
    EXPECT_LE(worst, c.error + bound) << c.name;
    EXPECT_GT(largest, 0.05) << c.name;
    EXPECT_LT(bound, 1e-6) << c.name << ": the reference must know its value";
    std::printf("%-12s largest error %.1e, bound of the reference %.1e\n", c.name, worst, bound);
  }
}

TEST(EvalRoundLight, AutoTakesGgxByQuality) {
  const AreaLight light = sphere({0, 2, 0}, 0.5);
  Material stretched = ggx(0.2);
  stretched.alpha_y = 0.4;
  EXPECT_EQ(ask(light, kFloor, ggx(0.2), Method::automatic, Quality::draft).method, "ltc-compact");
  EXPECT_EQ(ask(light, kFloor, ggx(0.2), Method::automatic, Quality::normal).method, "closed-form");
  EXPECT_EQ(ask(light, kFloor, ggx(0.2), Method::automatic, Quality::high).method, "closed-form");
  EXPECT_EQ(ask(light, kFloor, stretched, Method::automatic, Quality::draft).method, "closed-form") << "no table has it";
}

TEST(EvalRoundLight, SampledAgreesWithinItsStandardError) {
  const AreaLight light = sphere({0.5, 1, 0}, 0.4);
  const Answer truth = ask(light, kFloor, ggx(0.3), Method::reference), sampled = ask(light, kFloor, ggx(0.3), Method::sampled);
  EXPECT_NEAR(sampled.radiance.x, truth.radiance.x, 4 * *sampled.standard_error);
  EXPECT_LT(*sampled.standard_error, 0.05 * truth.radiance.x);
}

TEST(EvalRoundLight, HiddenSidesInsidesAndNoAreaGiveZero) {
  const AreaLight dark[] = {disk({0, 2, 0}, {0, 0, 1}, {1, 0, 0}),  // back side
                            disk({2, 0, 0}, {1, 0, 0}, {0, 0, 1}),  // the point is in the disk's plane
                            disk({0, 2, 0}, {1, 0, 0}, {2, 0, 0}),  // no area
                            disk({0, 2, 0}, {}, {}),
                            sphere({0, 0.5, 0}, 1),  // inside
                            sphere({0, 1, 0}, 0),
                            sphere({0, 0, 0}, 0),
                            sphere({0, -2, 0}, 1)};  // below the horizon
  for (const AreaLight& light : dark)
    for (const Material& m : {material_of(Brdf::lambert), ggx(0.3)})
      for (Method method : {Method::automatic, Method::reference, Method::sampled})
        EXPECT_EQ(ask(light, kFloor, m, method).radiance, Vec3d{}) << name_of(m.brdf) << " light " << (&light - dark);
  AreaLight both = dark[0];
  both.two_sided = true;
  EXPECT_NEAR(ask(both, kFloor, material_of(Brdf::lambert)).radiance.x, 0.2, 1e-14);
}

TEST(EvalRoundLight, DoesNotDependOnScale) {
  // Scaling by powers of two changes no digit.
  const double truth = ask(sphere({1, 2, 2}, 0.5), kFloor, ggx(0.3)).radiance.x;
  for (int power : {-400, -40, 40, 400}) {
    const double s = std::ldexp(1.0, power);
    EXPECT_NEAR(ask(sphere(Vec3d{1, 2, 2} * s, 0.5 * s), kFloor, ggx(0.3)).radiance.x, truth, 1e-14) << power;
  }
}

TEST(EvalRoundLight, ATinyOneIsAPointLight) {
  // Radii on both sides of the limit at which a sphere becomes a point. Intensity pi R^2, up to the rounding of the polygon's vertices.
  for (double radius : {1e-8, 1e-10, 1e-14}) {
    const double share = std::numbers::pi * radius * radius;
    const double expected = ask(sphere({1, 2, 2}, 1e-3), kFloor, ggx(0.3)).radiance.x * share / (std::numbers::pi * 1e-6);
    EXPECT_NEAR(ask(sphere({1, 2, 2}, radius), kFloor, ggx(0.3)).radiance.x / expected, 1, 0.01) << radius;
  }
}

}  // namespace steradian::eval::round_light_test
