// A fitted table under every kind of light: the method `ltc` against quadrature over the same table's lobe.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "core/random.h"
#include "integrals/tables/ggx_tables.h"
#include "lobes/lobe.h"
#include "steradian/radiance.h"

namespace steradian::fitted_lobe_test {
namespace {

using reference::Random;

// A table of no GGX: wider across the view, half as bright, and tilted.
std::shared_ptr<const ClassicTable> measured_table() {
  auto table = std::make_shared<ClassicTable>(ggx_classic_table());
  for (auto& m : table->matrix) m[0] *= 1.5f, m[2] += 0.1f;
  for (auto& m : table->magnitude) m[0] *= 0.5f;
  return table;
}

Material material_by(const ClassicTable& table, double alpha) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = alpha;
  m.f0 = {0.3, 0.5, 0.04};
  m.f90 = {1, 0.9, 1};
  m.fitted = &table;
  return m;
}

AreaLight profiled(const AreaLight& even) {
  LightProfile p;
  for (int v = 0; v <= 90; v += 10) p.vertical.push_back(v);
  p.horizontal = {0};
  for (const double v : p.vertical)
    p.candela.push_back(10 * std::cos(v * std::numbers::pi / 180) * (1 + std::exp(-(v - 40) * (v - 40) / 300)));
  AreaLight light = even;
  set_emission(light, std::make_shared<const LightProfile>(p), {1, 0, 0}, {1, 0.5, 0.25});
  return light;
}

struct Case {
  const char* name;
  AreaLight light;
  double error;  // of the method, in fractions of the answer
};

// docs/theory/round-lights.md: the polygon of 32 corners is off by 1e-3. ProfiledLight.ErrorsAreMeasured: the mean by 256 cells is off by
// 3.3e-3 at most. This test takes 1024.
std::vector<Case> lights() {
  const AreaLight panel{Polygon{{{-0.6, 1, -0.4}, {0.9, 1.1, -0.4}, {0.9, 1.1, 0.5}, {-0.6, 1, 0.5}}, {}}, {3, 2, 1}};
  AreaLight square{Polygon{{{-0.5, 1.5, -0.4}, {0.9, 1.5, -0.4}, {0.9, 1.5, 0.4}, {-0.5, 1.5, 0.4}}, {}}, {1, 1, 1}};
  AreaLight disk{Ellipse{{0.2, 1.5, 0}, {0.7, 0, 0}, {0, 0, 0.4}}, {3, 2, 1}};
  return {{"polygon", panel, 1e-9},
          {"disk", disk, 1e-3},
          {"ball", {Ellipsoid{{0.3, 1, 0.1}, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}, {3, 2, 1}}, 1e-3},
          {"tube", {Capsule{{-0.5, 1, 0}, {0.6, 1.2, 0.3}, 0.1}, {3, 2, 1}}, 2e-3},
          {"line", {Line{{-0.5, 1, 0}, {0.6, 1.2, 0.3}}, {3, 2, 1}}, 1e-4},
          {"profiled rect", profiled(square), 3.3e-3},
          {"profiled disk", profiled(disk), 3.3e-3}};
}

TEST(FittedLobe, LtcIsItsIntegralUnderEveryLight) {
  const auto table = measured_table();
  Random random(17);
  for (const Case& c : lights()) {
    double worst = 0;
    int lit = 0;
    for (int i = 0; i < 80; ++i) {
      const Material m = material_by(*table, std::exp(random.uniform(-3.5, 0)));
      const Vec3d view = normalized(Vec3d{random.uniform(-1, 1), random.uniform(0.1, 1), random.uniform(-1, 1)});
      const ShadingPoint at = {{random.uniform(-1, 1), 0, random.uniform(-1, 1)}, {0, 1, 0}, view};
      RadianceOptions options;
      options.method = Method::reference;
      const RadianceResult truth = radiance(c.light, at, m, options);
      options.method = Method::ltc;
      options.quality = Quality::high;
      options.table = table;
      const Vec3d value = radiance(c.light, at, m, options).radiance;
      const double scale = truth.radiance.x + 1e-2;  // a hundredth of what a filled lobe sends
      const double error = std::max(std::fabs(value.x - truth.radiance.x) - *truth.bound, 0.0) / scale;
      worst = std::max(worst, error);
      lit += truth.radiance.x > 1e-2;
      EXPECT_LT(error, c.error) << c.name << " " << i << " alpha " << m.alpha_x << " view " << view.y << " truth " << truth.radiance.x
                                << " value " << value.x;
    }
    std::printf("%s: worst %.1e\n", c.name, worst);
    EXPECT_GT(lit, 15) << c.name;
  }
}

// Its sampler draws what its density says, and the density is one over all directions.
TEST(FittedLobe, SamplesItsDensity) {
  const auto table = measured_table();
  for (const double alpha : {0.05, 0.5}) {
    const Vec3d view = normalized(Vec3d{0.3, -0.4, 0.6});
    const lobes::Lobe lobe(material_by(*table, alpha), view);
    Random random(5);
    Vec3d by_samples{}, by_density{};
    constexpr int kSamples = 200'000;
    for (int i = 0; i < kSamples; ++i) {
      const double u = random.uniform(), v = random.uniform();
      by_samples += lobe.sample(u, v) / kSamples;
      // A mixture of the lobe and of all directions covers both.
      const Vec3d l = i % 2 == 0 ? lobe.sample(v, u) : [&] {
        const double z = 2 * u - 1, r = std::sqrt(1 - z * z);
        return Vec3d{r * std::cos(2 * std::numbers::pi * v), r * std::sin(2 * std::numbers::pi * v), z};
      }();
      const double pdf = lobe.pdf(l);
      by_density += l * (pdf / (0.5 * pdf + 0.5 / (4 * std::numbers::pi)) / kSamples);
    }
    // The weights are at most 2, so five standard errors of each mean are below 0.025.
    EXPECT_NEAR(by_samples.x, by_density.x, 0.025) << alpha;
    EXPECT_NEAR(by_samples.y, by_density.y, 0.025) << alpha;
    EXPECT_NEAR(by_samples.z, by_density.z, 0.025) << alpha;
  }
}

}  // namespace
}  // namespace steradian::fitted_lobe_test
