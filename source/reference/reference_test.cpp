#include "steradian/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/gauss_kronrod.h"
#include "reference/random_configurations.h"

namespace steradian {
namespace {

using reference::describe;
using reference::Random;
using reference::random_configuration;
using reference::random_material;

double largest(Vec3d v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

}  // namespace

TEST(GaussKronrod, IntegratesPolynomialsOfItsDegreesExactly) {
  // Gauss: degree 13. Kronrod: degree 22, and 23 by symmetry.
  for (int degree = 0; degree <= 23; ++degree) {
    double gauss = 0, kronrod = 0;
    for (const auto& node : reference::kKronrodNodes) {
      gauss += node.gauss * std::pow(node.x, degree);
      kronrod += node.kronrod * std::pow(node.x, degree);
    }
    const double exact = degree % 2 == 0 ? 2.0 / (degree + 1) : 0;
    EXPECT_NEAR(kronrod, exact, 15 * 2.3e-16) << "degree " << degree;
    if (degree <= 13) {
      EXPECT_NEAR(gauss, exact, 15 * 2.3e-16) << "degree " << degree;
    }
  }
}

TEST(Reference, AgreesWithExactLambertOnAThousandPolygons) {
  Random random(1);
  int lit = 0;
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto c = random_configuration(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const double exact = polygon_irradiance(light, c.at.position, c.at.normal) / std::numbers::pi;
    const ReferenceResult r = reference_radiance(light, c.at, Material{});
    const double error = std::fabs(r.radiance.x - exact);
    EXPECT_LE(error, 1e-9) << i << ": " << c.kind << ", exact " << exact << ", bound " << r.bound;
    // The exact value carries roundings of its own, a few units of the last place of the vertices' directions.
    EXPECT_LE(error, r.bound + 1e-15) << i << ": " << c.kind << ", exact " << exact;
    lit += exact > 0;
    worst = std::max(worst, error);
  }
  EXPECT_GT(lit, 500);
  std::printf("largest difference %.2e, %d of 1000 lit\n", worst, lit);
}

TEST(Reference, BoundHoldsForEveryLobe) {
  Random random(2);
  int lit = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto c = random_configuration(random);
    const Material m = random_material(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    const ReferenceResult rough = reference_radiance(light, c.at, m, {1e-5, 1e-8, 400'000});
    const ReferenceResult fine = reference_radiance(light, c.at, m, {1e-11, 1e-14, 400'000});
    const double error = largest(rough.radiance - fine.radiance);
    EXPECT_LE(error, rough.bound + fine.bound) << i << ": " << describe(c, m) << ", value " << fine.radiance.x << " fine bound " << fine.bound;
    lit += fine.radiance.x > 1e-6;
  }
  std::printf("%d lit\n", lit);
}

}  // namespace steradian
