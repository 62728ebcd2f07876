#include "steradian/polygon_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/random_configurations.h"

namespace steradian::polygon_light_test {
namespace {

using reference::Random;
using reference::random_configuration;
using reference::random_direction;

PreparedPolygon polygon(std::vector<Vec3d> vertices, bool two_sided = true) {
  PolygonLight light;
  light.vertices = std::move(vertices);
  light.two_sided = two_sided;
  return prepare_polygon(light);
}

double factor(const PreparedPolygon& light, Vec3d position = {}, Vec3d normal = {0, 0, 1}) {
  return polygon_irradiance(light, position, normal) / std::numbers::pi;
}

}  // namespace

// Configuration factors of a differential element and a rectangle: Hamilton, Morgan, "Radiant-interchange configuration factors", NACA TN
// 2836, 1952. The cases are parallel, perpendicular and inclined; the element is always opposite a corner.
TEST(PolygonIrradiance, OfAParallelRectangleUnderItsCornerIsTheLiteratures) {
  for (double a : {0.01, 0.5, 1.0, 3.0, 100.0})
    for (double b : {0.1, 1.0, 20.0}) {
      const double x = std::sqrt(1 + a * a), y = std::sqrt(1 + b * b);
      const double expected = (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2 * std::numbers::pi);
      EXPECT_NEAR(factor(polygon({{0, 0, 1}, {a, 0, 1}, {a, b, 1}, {0, b, 1}})), expected, 1e-12) << a << " " << b;
    }
}

TEST(PolygonIrradiance, OfAPerpendicularRectangleIsTheLiteratures) {
  // The rectangle is at the distance 1 from the element, with width b along the floor and height a above it.
  for (double a : {0.01, 0.5, 1.0, 3.0, 100.0})
    for (double b : {0.1, 1.0, 20.0}) {
      const double d = std::sqrt(1 + a * a);
      const double expected = (std::atan(b) - std::atan(b / d) / d) / (2 * std::numbers::pi);
      EXPECT_NEAR(factor(polygon({{1, 0, 0}, {1, b, 0}, {1, b, a}, {1, 0, a}})), expected, 1e-12) << a << " " << b;
      // The part below the horizon adds nothing.
      EXPECT_NEAR(factor(polygon({{1, 0, -7}, {1, b, -7}, {1, b, a}, {1, 0, a}})), expected, 1e-12) << a << " " << b;
    }
}

TEST(PolygonIrradiance, OfAnInclinedRectangleIsTheLiteratures) {
  // The rectangle rises from the floor's line x = 1 at the angle phi with the floor, from the element outwards: length a
  // along the slope, width b. phi = pi / 2 is the case above.
  for (double phi : {0.1, 0.7, 1.5, 2.5, 3.0})
    for (double a : {0.1, 0.9, 5.0})
      for (double b : {0.2, 1.0, 20.0}) {
        // c: cosine between the slope and the line back to the element. v: from there to the upper edge.
        const double c = -std::cos(phi), s = std::sin(phi), v = std::sqrt(a * a - 2 * a * c + 1);
        const double root = std::sqrt(b * b + s * s);
        const double expected =
            (std::atan(b) + (a * c - 1) / v * std::atan(b / v) + b * c / root * (std::atan((a - c) / root) + std::atan(c / root))) /
            (2 * std::numbers::pi);
        const double x = 1 + a * std::cos(phi), z = a * s;
        EXPECT_NEAR(factor(polygon({{1, 0, 0}, {1, b, 0}, {x, b, z}, {x, 0, z}})), expected, 1e-12) << phi << " " << a << " " << b;
      }
}

TEST(PolygonIrradiance, OfRegularPolygonsIsTheirClosedFormAndTendsToTheDisk) {
  // The element is below the middle: every edge sends half its angle times its plane's cosine.
  const double radius = 1.3, disk = radius * radius / (1 + radius * radius);
  double previous = 1;
  for (int n = 3; n <= 3000; n *= 10) {
    std::vector<Vec3d> vertices;
    for (int i = 0; i < n; ++i) {
      const double phi = 2 * std::numbers::pi * i / n;
      vertices.push_back({radius * std::cos(phi), radius * std::sin(phi), 1});
    }
    const double apothem = radius * std::cos(std::numbers::pi / n), half_side = radius * std::sin(std::numbers::pi / n);
    const double slant = std::hypot(1, apothem);
    const double expected = n / std::numbers::pi * apothem / slant * std::atan(half_side / slant);
    const double found = factor(polygon(vertices));
    EXPECT_NEAR(found, expected, 1e-12) << n;
    EXPECT_LT(disk - found, previous) << n;
    // The polygon lacks segments of the disk: to first order the disk's area times (2/3) (pi/n)^2, at most doubled.
    EXPECT_LE(disk - found, radius * radius * (2.0 / 3) * (std::numbers::pi / n) * (std::numbers::pi / n) * 2 + 1e-12) << n;
    EXPECT_GT(disk - found, 0) << n;
    previous = disk - found;
  }
}

TEST(PolygonIrradiance, ComesFromTheLitSideOnly) {
  // Counter-clockwise as seen from the origin, which looks up: clockwise about +z.
  const std::vector<Vec3d> facing = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  std::vector<Vec3d> averted = facing;
  std::reverse(averted.begin(), averted.end());
  const double expected = factor(polygon(facing, true));
  EXPECT_GT(expected, 0.5);
  EXPECT_EQ(polygon(facing, false).side_of({}), 1);
  EXPECT_EQ(polygon(averted, false).side_of({}), -1);
  EXPECT_EQ(factor(polygon(facing, false)), expected);
  EXPECT_EQ(factor(polygon(averted, false)), 0);
  EXPECT_NEAR(factor(polygon(averted, true)), expected, 1e-15);
  // From above, looking down, the order is reversed.
  const Vec3d above{0, 0, 2}, down{0, 0, -1};
  EXPECT_EQ(factor(polygon(facing, false), above, down), 0);
  EXPECT_NEAR(factor(polygon(averted, false), above, down), expected, 1e-15);
  // In its plane nothing of the light is visible.
  EXPECT_EQ(factor(polygon(facing), {5, 0, 1}), 0);
}

TEST(PolygonIrradiance, IsAdditiveWhenAPolygonIsCut) {
  Random random(11);
  int lit = 0;
  for (int i = 0; i < 500; ++i) {
    const auto c = random_configuration(random);
    if (!c.light.holes.empty()) continue;
    // The polygon is cut from the first vertex: both parts share the diagonal, whether it lies inside or not.
    const auto& v = c.light.vertices;
    const auto whole = polygon(v);
    if (v.size() < 4) continue;
    const auto cut = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::vector<Vec3d> first(v.begin(), cut + 1), second(cut, v.end());
    second.insert(second.begin(), v.front());
    const auto a = polygon(first), b = polygon(second);
    // A part of a non-convex outline may run the other way and then counts negative.
    const auto sign = [&](const PreparedPolygon& p) { return dot(p.normal, whole.normal) > 0 ? 1.0 : -1.0; };
    const double sum = sign(a) * factor(a, c.at.position, c.at.normal) + sign(b) * factor(b, c.at.position, c.at.normal);
    const double all = factor(whole, c.at.position, c.at.normal);
    EXPECT_NEAR(all, sum, 1e-12) << i << " " << c.kind;
    lit += all > 0;
  }
  EXPECT_GT(lit, 200);
}

TEST(PolygonIrradiance, IgnoresLightBelowTheHorizon) {
  Random random(12);
  for (int i = 0; i < 100; ++i) {
    const Vec3d normal = random_direction(random);
    const Frame frame = Frame::from_normal(normal);
    std::vector<Vec3d> below;
    const Vec3d centre{random.uniform(-2, 2), random.uniform(-2, 2), -2};
    const Frame tilt = Frame::from_normal(random_direction(random));
    for (const Vec3d& v : reference::random_star(random, tilt, centre, 1.9, 7, 0.5)) below.push_back(frame.to_world(v));
    EXPECT_EQ(factor(polygon(below), {}, normal), 0) << i;
    EXPECT_GT(polygon_solid_angle(polygon(below), {}), 0) << i;
  }
}

TEST(PolygonIrradiance, OrderOfHolesAndOfTheirVerticesDoesNotMatter) {
  PolygonLight light;
  light.vertices = {{-2, -2, 1}, {-2, 2, 1}, {2, 2, 1}, {2, -2, 1}};
  const std::vector<Vec3d> left = {{-1, -1, 1}, {-1, 1, 1}, {-0.5, 0, 1}}, right = {{1, -1, 1}, {1, 1, 1}, {0.5, 0, 1}};
  const double without = factor(prepare_polygon(light));
  const double expected = without - factor(polygon(left)) - factor(polygon(right));
  const std::vector<Vec3d> reversed(left.rbegin(), left.rend());
  for (const auto& holes : {std::vector{left, right}, std::vector{right, left}, std::vector{reversed, right}}) {
    light.holes = holes;
    EXPECT_NEAR(factor(prepare_polygon(light)), expected, 1e-14);
  }
  EXPECT_LT(expected, without - 0.05);
}

// An outline that is flat up to its own rounding is accepted, however thin it is.
TEST(PreparedPolygon, TakesThinOutlines) {
  Random random(13);
  for (double width = 1; width > 1e-13; width /= 10)
    for (int i = 0; i < 200; ++i) {
      const Frame frame = Frame::from_normal(random_direction(random));
      const Vec3d centre = random_direction(random);
      PolygonLight light;
      for (int k = 0; k < 12; ++k)
        light.vertices.push_back(centre + frame.x * std::cos(k * M_PI / 6) + frame.y * (width * std::sin(k * M_PI / 6)));
      ASSERT_NO_THROW(EXPECT_FALSE(prepare_polygon(light).vertices.empty())) << width;
    }
}

// A point nearer to the plane than rounding has no side: the direction of its arcs is arbitrary, whatever a sign says.
TEST(PreparedPolygon, APointInItsPlaneHasNoSide) {
  Random random(14);
  for (int i = 0; i < 2000; ++i) {
    const auto c = reference::random_configuration(random);
    const PreparedPolygon light = prepare_polygon(c.light);
    Vec3d p{};
    double weights = 0;
    for (const Vec3d& v : c.light.vertices) {
      const double w = random.uniform();
      p += v * w;
      weights += w;
    }
    p = p / weights;
    EXPECT_EQ(light.side_of(p), 0) << i << " " << c.kind;
    EXPECT_NE(light.side_of(p + light.normal * 1e-6 * (1 + length(p))), 0) << i << " " << c.kind;
  }
}

}  // namespace steradian::polygon_light_test
