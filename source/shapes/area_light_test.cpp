#include "steradian/area_light.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace steradian::area_light_test {
namespace {

TEST(AreaLight, GivesAnEllipseAPolygonOfItsArea) {
  for (const int k : {3, 8, 64}) {
    const PreparedPolygon p = prepare_polygon(equal_area_polygon({{1, 2, 3}, {2, 0, 0}, {0.5, 1, 0}}, {1, 1, 1}, k));
    EXPECT_NEAR(p.area, 2 * std::numbers::pi, 1e-12) << k;
    EXPECT_NEAR(p.normal.z, 1, 1e-12);
  }
}

TEST(AreaLight, GivesASphereTheSolidAngleItHas) {
  AreaLight light;
  const Vec3d center{1, 2, 3};
  light.shape = Ellipsoid{center, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, -0.5}};  // left-handed axes too
  for (const double distance : {0.6, 1.0, 4.0}) {
    const Vec3d position = center + normalized(Vec3d{1, -2, 0.5}) * distance;
    const double s = 0.5 / distance, exact = 2 * std::numbers::pi * s * s / (1 + std::sqrt(1 - s * s));
    // The K-gon's solid angle differs from the cone's by O(1/K^4) at equal area near the centre and O(1/K^2)
    // at most.
    const double polygon = polygon_solid_angle(prepare_polygon(polygon_seen_from(light, position, 64)), position);
    EXPECT_NEAR(polygon / exact, 1, (2 * std::numbers::pi / 64) * (2 * std::numbers::pi / 64)) << distance;
    const double finer = polygon_solid_angle(prepare_polygon(polygon_seen_from(light, position, 640)), position);
    EXPECT_LE(std::fabs(finer / exact - 1), std::fabs(polygon / exact - 1) / 50 + 1e-9) << distance;
  }
  EXPECT_TRUE(polygon_seen_from(light, center + Vec3d{0.1, 0, 0}).vertices.empty()) << "from inside";
}

// Rays to the outline touch the ellipsoid: the quadratic in the ray's parameter has a double root.
TEST(AreaLight, OutlinesAnEllipsoidByRaysThatTouchIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Vec3d{number(random), number(random), number(random)}; };
  int seen = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3d center = vector(), x = vector(), y = vector(), z = vector(), position = vector() * 8.0;
    const double det = dot(cross(x, y), z);
    if (std::fabs(det) < 0.05) continue;
    const auto outline = silhouette({center, x, y, z}, position);
    const auto to_unit = [&](Vec3d v) { return Vec3d{dot(cross(y, z), v), dot(cross(z, x), v), dot(cross(x, y), v)} / det; };
    const Vec3d p = to_unit(position - center);
    ASSERT_EQ(outline.has_value(), length(p) > 1);
    if (!outline) continue;
    ++seen;
    EXPECT_GT(dot(cross(outline->x, outline->y), position - outline->center), 0) << "faces the point";
    for (int k = 0; k < 8; ++k) {
      const double t = k * std::numbers::pi / 4;
      const Vec3d d = to_unit(outline->center + outline->x * std::cos(t) + outline->y * std::sin(t) - position);
      const double half_b = dot(p, d), a = dot(d, d), c = dot(p, p) - 1;
      // Error budget: each product is rounded a few times, magnified by the inverse of the axes' determinant
      // (< 20).
      EXPECT_NEAR(half_b * half_b / (a * c), 1, 1e-10) << i;
    }
  }
  EXPECT_GT(seen, 100);
}

}  // namespace
}  // namespace steradian::area_light_test
