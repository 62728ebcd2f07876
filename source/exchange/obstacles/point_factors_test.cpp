// Factors of points against constants, and the sky that is left.
#include "exchange/obstacles/point_factors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace steradian::exchange::point_factors_test {
namespace {

PlaneElement parallelogram(Vec3d corner, Vec3d a, Vec3d b) {
  return make_element({corner, corner + a, corner + a + b, corner + b}, {}, "element");
}

TEST(PointFactors, HaveTheExactValues) {
  const Sensor up{{0, 0, 0}, {0, 0, 1}};
  const Obstacles none;
  // 30-digit arithmetic; both are differences of arctangents.
  EXPECT_NEAR(point_factor(up, parallelogram({0, 0, 1}, {0, 1, 0}, {1, 0, 0}), none).value, 0.1385316059948929968, 1e-15);
  EXPECT_NEAR(point_factor(up, parallelogram({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}), none).value, 0.5541264239795719871, 1e-15);
  EXPECT_EQ(point_factor(up, parallelogram({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), none).value, 0);  // its back
  EXPECT_EQ(point_factor({{0, 0, 0}, {0, 0, -1}}, parallelogram({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}), none).value, 0);
  // A quarter of the centred square is hidden: what is left is three quarters.
  const Vec3d a{0, 0, 0.5}, b{0.5, 0, 0.5}, c{0.5, 0.5, 0.5}, d{0, 0.5, 0.5};
  const Obstacles quarter(std::vector<ObstacleTriangle>{{a, b, c}, {a, c, d}});
  EXPECT_NEAR(point_factor(up, parallelogram({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}), quarter).value, 0.75 * 0.5541264239795719871, 1e-12);
}

TEST(PointFactors, LeaveTheSkyOfACanyon) {
  // Walls as high as the street is wide: the middle of the street has 1/sqrt 5 of sky, and a length of 2 L adds an error of O(1/L^2).
  const double half = 1000;
  const std::vector<PlaneElement> walls = {parallelogram({-0.5, -half, 0}, {0, 2 * half, 0}, {0, 0, 1}),
                                           parallelogram({0.5, -half, 0}, {0, 0, 1}, {0, 2 * half, 0})};
  std::vector<ObstacleTriangle> triangles;
  for (const PlaneElement& e : walls)
    for (const PlaneElement& t : triangles_of_element(e, "wall"))
      triangles.push_back({t.contours[0][0], t.contours[0][1], t.contours[0][2]});
  const SensorFactors f = sensor_factors({{0, 0, 0}, {0, 0, 1}}, walls, Obstacles(triangles));
  EXPECT_TRUE(f.is_proven);
  EXPECT_NEAR(f.sky, 1 / std::sqrt(5.0), 1e-6);
  EXPECT_EQ(f.backs, 0);
  EXPECT_NEAR(f.fronts[0], f.fronts[1], 1e-14);
}

TEST(PointFactors, OfAFurnishedRoomAddUpToOne) {
  // The sensor sees the walls, and fronts and backs of a screen that hides a part of them.
  std::vector<PlaneElement> elements;
  const Vec3d x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
  for (const PlaneElement& e :
       {parallelogram({}, x, y), parallelogram(z, y, x), parallelogram({}, y, z), parallelogram(x, z, y), parallelogram({}, z, x),
        parallelogram(y, x, z), parallelogram({0.5, 0.5, 0.8}, {1, 0.3, 0.2}, {0.1, 0.9, -0.2})})
    elements.push_back(e);
  std::vector<ObstacleTriangle> triangles;
  for (const PlaneElement& e : elements)
    for (const PlaneElement& t : triangles_of_element(e, "face"))
      triangles.push_back({t.contours[0][0], t.contours[0][1], t.contours[0][2]});
  const Obstacles obstacles(triangles);
  for (const Sensor& s :
       {Sensor{{1, 1, 0}, {0, 0, 1}}, Sensor{{0, 0.7, 1.1}, {1, 0, 0}}, Sensor{{1, 1, 1.5}, normalized(Vec3d{0.3, 0.2, -1})}}) {
    const SensorFactors f = sensor_factors(s, elements, obstacles);
    double sum = f.backs;
    for (const double front : f.fronts) sum += front;
    EXPECT_NEAR(sum, 1, 1e-10);
    EXPECT_GT(f.fronts[6] + f.backs, 0.05);
  }
}

}  // namespace
}  // namespace steradian::exchange::point_factors_test
