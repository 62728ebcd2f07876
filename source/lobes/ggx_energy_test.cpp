// The table of directional albedos against quadrature over visible normals.
#include "lobes/ggx_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/random.h"
#include "lobes/lobe.h"

namespace steradian::lobes {
namespace {

LobeValue energy_by_quadrature(double alpha, double cosine) {
  constexpr int kSide = 384;
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = alpha;
  const Lobe lobe(m, {std::sqrt(1 - cosine * cosine), 0, cosine});
  LobeValue sum{};
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Vec3d l = lobe.sample((i + 0.5) / kSide, (j + 0.5) / kSide);
      const double pdf = lobe.pdf(l);
      if (l.z > 0 && pdf > 0) sum += lobe.evaluate(l) * (1 / (pdf * kSide * kSide));
    }
  return sum;
}

TEST(GgxEnergy, IsTheIntegralOfTheLobe) {
  reference::Random random(3);
  double worst = 0;
  for (int k = 0; k < 100; ++k) {
    const double roughness = random.uniform(0.05, 1), cosine = random.uniform(0.05, 1), alpha = roughness * roughness;
    const LobeValue table = ggx_energy(alpha, cosine), exact = energy_by_quadrature(alpha, cosine);
    worst = std::max({worst, std::fabs(table.plain - exact.plain), std::fabs(table.fresnel - exact.fresnel)});
  }
  std::printf("largest error %.1e\n", worst);
  EXPECT_LT(worst, 2e-3);  // as its header says
  EXPECT_NEAR(ggx_energy(0, 0.5).plain, 1, 1e-12);
  EXPECT_NEAR(ggx_energy(0, 1).fresnel, 0, 1e-12);
}

TEST(GgxEnergy, IsKnownForIsotropicGgxAlone) {
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = 0.2;
  m.f0 = {0.5, 0.25, 0};
  m.f90 = {1, 1, 1};
  const auto albedo = known_albedo(m, 0.6);
  ASSERT_TRUE(albedo);
  const LobeValue energy = ggx_energy(0.2, 0.6);
  EXPECT_NEAR(albedo->x, 0.5 * energy.plain + 0.5 * energy.fresnel, 1e-12);
  EXPECT_NEAR(albedo->z, energy.fresnel, 1e-12);
  m.alpha_y = 0.3;
  EXPECT_FALSE(known_albedo(m, 0.6));
}

}  // namespace
}  // namespace steradian::lobes
