// Capsules and lines: irradiance against spheres, region tests, fine polygons and quadrature; polygons for lobes against finer ones; and
// properties that hold for any input.
#include "steradian/capsule_light.h"
#include "steradian/ellipse_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/closed_form.h"
#include "steradian/error.h"
#include "steradian/phong.h"
#include "support/random_configurations.h"

namespace steradian::capsule_light_test {
namespace {

using reference::Random;
using reference::random_direction;

// A tube about a point at distance 1 in that direction. Its radius subtends 2 to 35 degrees or a third of that; its length is up to 6.
Capsule random_tube(Random& random, Vec3d direction) {
  const double thin = random.uniform() < 0.5 ? 0.3 : 1.0;
  const double radius = std::tan(random.uniform(2, 35) * std::numbers::pi / 180) * 0.7 * thin;
  const Vec3d along = random_direction(random) * std::pow(10, random.uniform(-1.5, 0.5));
  return {direction - along * random.uniform(), direction + along * random.uniform(), radius};
}

double sphere_irradiance(Vec3d center, double radius, Vec3d normal) {
  return ellipsoid_irradiance({center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}, {}, normal);
}

// Fraction of the cosine-weighted directions that meet the capsule, times pi: strata, one sample in each.
double irradiance_by_rays(const Capsule& c, Vec3d normal, int side, Random& random) {
  const Frame frame = Frame::from_normal(normal);
  int hits = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double u = (i + random.uniform()) / side, phi = 2 * std::numbers::pi * (j + random.uniform()) / side;
      const Vec3d d = frame.to_world({std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi), std::sqrt(1 - u)});
      hits += distance_to_axis(c, d * distance_along(c, {}, d)) < c.radius;
    }
  return std::numbers::pi * hits / (static_cast<double>(side) * side);
}

}  // namespace

TEST(CapsuleIrradiance, OfNoLengthIsTheSpheres) {
  Random random(1);
  double worst = 0, worst_float = 0, worst_near = 0;
  for (int i = 0; i < 2000; ++i) {
    const double radius = random.uniform(0.001, 0.95);
    const Vec3d center = random_direction(random), normal = random_direction(random);
    const double sphere = sphere_irradiance(center, radius, normal);
    worst = std::max(worst, std::fabs(capsule_irradiance({center, center, radius}, {}, normal) - sphere));
    const double in_float = static_cast<double>(capsule_irradiance_float({center, center, radius}, {}, normal));
    worst_float = std::max(worst_float, std::fabs(in_float - sphere));
    // A length L adds at most 2 R L plus the part of the sphere that it covers: 2 L / (1 - R) of its directions.
    const double length = 1e-9;
    const Vec3d end = center + random_direction(random) * length;
    worst_near = std::max(worst_near, std::fabs(capsule_irradiance({center, end, radius}, {}, normal) - sphere) * (1 - radius) / length);
  }
  std::printf("largest difference %.2e, in float %.2e; over the length %.2f\n", worst, worst_float, worst_near);
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(worst_float, 1e-5);
  EXPECT_LT(worst_near, 2 * std::numbers::pi);
}

TEST(CapsuleIrradiance, AlongTheAxisIsTheNearerSpheres) {
  const Vec3d along = normalized(Vec3d{1, 2, 3});
  for (double aside : {0.0, 0.1, 0.29}) {
    const Vec3d shift = normalized(cross(along, {0, 0, 1})) * aside;
    const Capsule c{along + shift, along * 5.0 + shift, 0.3};
    EXPECT_NEAR(capsule_irradiance(c, {}, along), sphere_irradiance(c.end_a, 0.3, along), 1e-14) << aside;
    EXPECT_NEAR(capsule_irradiance({c.end_b, c.end_a, 0.3}, {}, along), sphere_irradiance(c.end_a, 0.3, along), 1e-14) << aside;
  }
}

TEST(CapsuleIrradiance, IsContinuousWhereASphereBecomesATube) {
  // The second ball emerges from behind the first: its contribution begins with the 3/2 power of its path.
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3d normal = random_direction(random), along = random_direction(random);
    const Vec3d aside = normalized(cross(along, random_direction(random)));
    const double radius = random.uniform(0.01, 0.9);
    const auto at = [&](double height) {
      const Vec3d shift = aside * height;
      return capsule_irradiance({along + shift, along * 4.0 + shift, radius}, {}, normal);
    };
    worst = std::max(worst, std::fabs(at(radius * (1 + 1e-9)) - at(radius * (1 - 1e-9))));
  }
  EXPECT_LT(worst, 1e-7);
  std::printf("largest step over 2e-9 of the height %.2e\n", worst);
}

TEST(CapsuleIrradiance, CountsTheRaysThatMeetIt) {
  Random random(3);
  constexpr int kSide = 700;
  for (int i = 0; i < 20; ++i) {
    const Vec3d direction = random_direction(random);
    const Capsule c = random_tube(random, direction);
    const Vec3d normal = normalized(direction + random_direction(random));
    if (!(distance_to_axis(c, {}) > c.radius)) continue;
    // An outline crosses at most 8 cells of a row or column; the variance of each is at most a quarter of a cell's.
    const double sigma = std::numbers::pi * 0.5 * std::sqrt(8.0 * kSide) / (kSide * kSide);
    EXPECT_NEAR(capsule_irradiance(c, {}, normal), irradiance_by_rays(c, normal, kSide, random), 4 * sigma) << "tube " << i;
  }
}

TEST(CapsuleIrradiance, AgreesWithFinePolygonsAcrossTheHorizon) {
  Random random(4);
  double worst = 0, worst_float = 0, worst_bound = 0;
  int cut = 0;
  for (int i = 0; i < 600; ++i) {
    const Capsule c = random_tube(random, random_direction(random));
    const Vec3d normal = random_direction(random);
    if (!(distance_to_axis(c, {}) > c.radius * 1.001)) continue;
    const auto polygon = [&](int n) { return polygon_irradiance(prepare_polygon(polygon_of_equal_steps(c, {}, n)), {}, normal); };
    const double fine = polygon(1024), bound = std::fabs(fine - polygon(512));
    const double value = capsule_irradiance(c, {}, normal);
    EXPECT_LE(std::fabs(value - fine), bound + 1e-12) << "tube " << i;
    worst = std::max(worst, std::fabs(value - fine));
    worst_bound = std::max(worst_bound, bound);
    worst_float = std::max(worst_float, std::fabs(static_cast<double>(capsule_irradiance_float(c, {}, normal)) - value));
    cut += value > 1e-6 && std::min(dot(c.end_a, normal), dot(c.end_b, normal)) < c.radius;
  }
  std::printf("largest difference %.2e (bound %.2e), in float %.2e, %d cut by the horizon\n", worst, worst_bound, worst_float, cut);
  EXPECT_LT(worst, 1e-8);
  EXPECT_LT(worst_float, 1e-5);
  EXPECT_GT(cut, 100);
}

TEST(CapsuleIrradiance, OfAnyInputIsFiniteAndWithinPi) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const auto coordinate = [&] {
      const double u = random.uniform();
      if (u < 0.2) return 0.0;
      if (u < 0.3) return 1.0;
      return (random.uniform() < 0.5 ? -1 : 1) * std::pow(10, u < 0.5 ? random.uniform(-150, 150) : random.uniform(-2, 2));
    };
    const auto point = [&] { return Vec3d{coordinate(), coordinate(), coordinate()}; };
    Capsule c{point(), point(), std::fabs(coordinate())};
    if (i % 5 == 0) c.end_b = c.end_a * 3.0;
    const Vec3d position = i % 7 == 0 ? c.end_a * 0.5 : point(), normal = random_direction(random);
    for (double e : {capsule_irradiance(c, position, normal), static_cast<double>(capsule_irradiance_float(c, position, normal))}) {
      EXPECT_GE(e, 0.0) << i;  // fails for NaN
      EXPECT_LE(e, std::numbers::pi + 1e-6) << i;
    }
    EXPECT_GE(line_irradiance(c.end_a, c.end_b, position, normal), 0.0) << i;
    EXPECT_GE(line_irradiance_float(c.end_a, c.end_b, position, normal), 0.0f) << i;
    if (!(distance_to_axis(c, position) > c.radius)) {
      EXPECT_EQ(capsule_irradiance(c, position, normal), 0.0) << "inside";
    }
  }
}

TEST(CapsuleIrradiance, OfATubeAtTheSurfaceIsAllOfTheSky) {
  // The view is straight at a huge tube from close by: pi (1 - the part that escapes along it).
  EXPECT_NEAR(capsule_irradiance({{-1e6, 0, 1}, {1e6, 0, 1}, 1 - 1e-9}, {}, {0, 0, 1}), std::numbers::pi, 1e-4);
  EXPECT_EQ(capsule_irradiance({{-1e6, 0, 1}, {1e6, 0, 1}, 1 - 1e-9}, {}, {0, 0, -1}), 0.0);
}

TEST(LineIrradiance, OfAnEndlessLineOverheadIsItsClosedForm) {
  for (double h : {0.01, 1.0, 300.0}) {
    EXPECT_NEAR(line_irradiance({-1e9, 0, h}, {1e9, 0, h}, {}, {0, 0, 1}) * h, std::numbers::pi / 2, 1e-12);
    EXPECT_NEAR(static_cast<double>(line_irradiance_float({-1e4, 0, h}, {1e4, 0, h}, {}, {0, 0, 1})) * h, std::numbers::pi / 2, 1e-4);
  }
}

TEST(LineIrradiance, IsItsIntegral) {
  // INT sin(angle to the line) cos / d^2 ds above the horizon, by Simpson's rule in the angle that it subtends.
  Random random(6);
  double worst = 0, worst_float = 0;
  int cut = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3d a = random_direction(random) * random.uniform(0.2, 3), b = random_direction(random) * random.uniform(0.2, 3);
    const Vec3d normal = random_direction(random), along = normalized(b - a), foot = a - along * dot(a, along);
    const double height = length(foot);
    if (height < 1e-3) continue;
    double from = std::atan2(dot(a, along), height), to = std::atan2(dot(b, along), height);
    // ds = height / cos^2, d = height / cos, sine = cos: the integrand is (foot cos + height along sin) . normal cos / height^2.
    const double up = dot(foot, normal) / height, forward = dot(along, normal);
    const double crossing = std::atan2(-up, forward);  // where cos up + sin forward = 0, to within half a turn
    const double edge = crossing > std::numbers::pi / 2    ? crossing - std::numbers::pi
                        : crossing < -std::numbers::pi / 2 ? crossing + std::numbers::pi
                                                           : crossing;
    if (from < edge && edge < to) {
      ++cut;
      (up * std::cos(from) + forward * std::sin(from) < 0 ? from : to) = edge;
    }
    double sum = 0;
    constexpr int kSteps = 400;
    for (int k = 0; k <= kSteps; ++k) {
      const double t = from + (to - from) * k / kSteps;
      const double f = std::max(std::cos(t) * up + std::sin(t) * forward, 0.0) * std::cos(t) / height;
      sum += f * (k == 0 || k == kSteps ? 1 : k % 2 == 1 ? 4 : 2);
    }
    const double expected = sum * (to - from) / (3 * kSteps);
    worst = std::max(worst, std::fabs(line_irradiance(a, b, {}, normal) - expected) * height);
    worst_float = std::max(worst_float, std::fabs(static_cast<double>(line_irradiance_float(a, b, {}, normal)) - expected) * height);
  }
  std::printf("largest difference over 1/height %.2e, in float %.2e, %d cut\n", worst, worst_float, cut);
  EXPECT_LT(worst, 1e-9);  // Simpson: (pi / 400)^4 / 180 times a fourth derivative of 2^4
  EXPECT_LT(worst_float, 1e-4);
  EXPECT_GT(cut, 100);
}

TEST(LineIrradiance, IsTheLimitOfThinCapsules) {
  Random random(7);
  for (double share : {1e-1, 1e-2, 1e-4, 1e-6}) {
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
      const Vec3d a = random_direction(random) * random.uniform(0.2, 3);
      Vec3d b = random_direction(random) * random.uniform(0.2, 3);
      if (i % 3 == 0) b = a * random.uniform(1, 9) + b * (share * random.uniform(0, 3));  // nearly end-on
      const Vec3d normal = random_direction(random);
      const double distance = distance_to_axis({a, b, 0}, {}), radius = share * distance;
      const double over_width = capsule_irradiance({a, b, radius}, {}, normal) / (2 * radius);
      worst = std::max(worst, std::fabs(over_width - line_irradiance(a, b, {}, normal)) * distance);
    }
    // Each end adds half a cap, of pi r^2/m^2 sr at most; the tube's own correction is of second order.
    EXPECT_LE(worst, std::numbers::pi / 2 * share * (1 + 4 * share) + 1e-9) << share;
    std::printf("radius over distance %.0e: difference over 1/distance %.2e, bound %.2e\n", share, worst,
                std::numbers::pi / 2 * share * (1 + 4 * share));
  }
}

TEST(LineIrradiance, TowardsThePointIsZero) {
  EXPECT_NEAR(line_irradiance({0, 0, 1}, {0, 0, 2}, {}, {0, 0, 1}), 0.0, 1e-16);
  EXPECT_EQ(line_irradiance({0, 0, 1}, {0, 0, 1}, {}, {0, 0, 1}), 0.0) << "no length";
}

TEST(CapsulePolygons, PhongLobesHoldTheirError) {
  for (double n : {10.0, 100.0, 1000.0, 5000.0}) {
    Random random(8);
    double worst[3] = {}, squares[3] = {}, even_worst = 0;
    int count = 0;
    const int vertices[3] = {8, 12, 16};
    for (int i = 0; i < 300; ++i) {
      const Vec3d direction = normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.3, 1)});
      const Capsule c = random_tube(random, direction);
      const Vec3d axis = normalized(direction + random_direction(random) * (random.uniform() * 0.7));
      if (!(distance_to_axis(c, {}) > c.radius * 1.02) || !(axis.z > 0.05)) continue;
      const ShadingPoint at = {{}, {0, 0, 1}, {-axis.x, -axis.y, axis.z}};
      Material m;
      m.brdf = Brdf::phong;
      m.exponent = n;
      const auto radiance = [&](const PolygonLight& light) {
        return phong_radiance(prepare_polygon(light), at, m, {.method = Method::exact}).x;
      };
      const double truth = radiance(polygon_of_equal_steps(c, {}, 512));
      for (int k = 0; k < 3; ++k) {
        const double error = std::fabs(radiance(polygon_for_lobe(c, {}, lobe_axis(m, at), vertices[k])) - truth);
        worst[k] = std::max(worst[k], error);
        squares[k] += error * error;
      }
      even_worst = std::max(even_worst, std::fabs(radiance(polygon_of_equal_steps(c, {}, 12)) - truth));
      ++count;
    }
    std::printf("n = %4.0f: of the full lobe, largest and rms", n);
    for (int k = 0; k < 3; ++k) std::printf(" K = %d %.5f %.5f,", vertices[k], worst[k], std::sqrt(squares[k] / count));
    std::printf(" 12 at equal steps %.5f\n", even_worst);
    // Chords differ from the outline to second order in the steps, and equal areas reduce that further. More corners of the same kind leave
    // at most the square of the steps' ratio.
    EXPECT_LE(squares[1], squares[0] * std::pow(8.0 / 12, 4)) << "n " << n;
    EXPECT_LE(squares[2], squares[1] * std::pow(12.0 / 16, 4)) << "n " << n;
    EXPECT_LE(worst[2], 0.0014) << "n " << n << ": what docs/theory/ggx.md states of round lights";
    // Gathered corners have steps as fine as the lobe is narrow, so sharper lobes must gain more from them.
    EXPECT_LE(worst[1], even_worst * std::min(1.0, std::sqrt(40 / n)) + 1e-9) << "n " << n;
  }
}

TEST(CapsulePolygons, GgxHoldsItsError) {
  Random random(9);
  double worst[2] = {}, sum[2] = {};
  int count = 0;
  for (int i = 0; i < 400; ++i) {
    const double view = random.uniform(5, 75) * std::numbers::pi / 180;
    const ShadingPoint at = {{}, {0, 0, 1}, {-std::sin(view), 0, std::cos(view)}};
    const Vec3d mirror{std::sin(view), 0, std::cos(view)};
    const Capsule c = random_tube(random, normalized(mirror + random_direction(random) * 0.4));
    if (!(distance_to_axis(c, {}) > c.radius * 1.02)) continue;
    Material m;
    m.brdf = Brdf::ggx;
    m.alpha_x = m.alpha_y = random.uniform(0.05, 0.4);
    const auto radiance = [&](const PolygonLight& light) { return closed_form_radiance(prepare_polygon(light), at, m, Quality::high).x; };
    const double truth = radiance(polygon_of_equal_steps(c, {}, 256));
    const int vertices[2] = {12, 16};
    for (int k = 0; k < 2; ++k) {
      const double error = std::fabs(radiance(polygon_for_lobe(c, {}, lobe_axis(m, at), vertices[k])) - truth);
      worst[k] = std::max(worst[k], error);
      sum[k] += error * error;
    }
    ++count;
  }
  for (int k = 0; k < 2; ++k) std::printf("K = %d: largest error %.5f, rms %.5f\n", 12 + 4 * k, worst[k], std::sqrt(sum[k] / count));
  EXPECT_LE(worst[0], 0.01);
  EXPECT_LE(worst[1], 0.005);
}

TEST(CapsulePolygons, LieInFrontOfThePointEvenAtTheSurface) {
  Random random(10);
  for (int i = 0; i < 2000; ++i) {
    const double radius = std::pow(10, random.uniform(-3, 1)), gap = radius * std::pow(10, random.uniform(-4, 0));
    const Vec3d along = random_direction(random), aside = normalized(cross(along, random_direction(random)));
    const Vec3d middle = aside * (radius + gap);
    const Capsule c{middle - along * std::pow(10, random.uniform(-2, 3)), middle + along * std::pow(10, random.uniform(-2, 3)), radius};
    for (int vertices : {8, 12, 64}) {
      const PreparedPolygon polygon = prepare_polygon(polygon_for_lobe(c, {}, {random_direction(random), 0.05}, vertices));
      const PreparedPolygon even = prepare_polygon(polygon_of_equal_steps(c, {}, vertices));
      ASSERT_EQ(polygon.side_of({}), 1) << i;
      ASSERT_EQ(even.side_of({}), 1) << i;
      // Chords of steps d omit 1 - sin(d)/d = d^2/6 - d^4/120 of a circle; with equal steps, equal areas restore the first term.
      const double exact = capsule_irradiance(c, {}, aside), d = 2 * std::numbers::pi / vertices;
      EXPECT_NEAR(polygon_irradiance(polygon, {}, aside), exact, exact * d * d / 6) << i << " with " << vertices;
      EXPECT_NEAR(polygon_irradiance(even, {}, aside), exact, exact * d * d * d * d / 120) << i << " with " << vertices;
    }
  }
}

TEST(CapsulePolygons, AreNoneFromInsideAndRefuseTooFewVertices) {
  const Capsule c{{-1, 0, 0.5}, {1, 0, 0.5}, 0.6};
  EXPECT_TRUE(polygon_of_equal_steps(c, {}, 12).vertices.empty());
  EXPECT_THROW(polygon_of_equal_steps(c, {0, 0, 5}, 5), Error);
}

TEST(Capsule, KnowsItsDistances) {
  const Capsule c{{-1, 0, 0}, {1, 0, 0}, 0.5};
  EXPECT_DOUBLE_EQ(distance_to_axis(c, {0.3, 3, 4}), 5);
  EXPECT_DOUBLE_EQ(distance_to_axis(c, {4, 4, 0}), 5);
  EXPECT_DOUBLE_EQ(distance_along(c, {0, 0, -2}, {0, 0, 1}), 2);
  EXPECT_DOUBLE_EQ(distance_along(c, {3, 0, 0}, {-1, 0, 0}), 2) << "along itself: the nearer end";
  EXPECT_DOUBLE_EQ(distance_along(c, {0, 0, -2}, {0, 0, -1}), 0) << "behind";
}

}  // namespace steradian::capsule_light_test
