// Triangles of outlines: they cover the outline's area, and no part of it twice.
#include "shapes/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace steradian::triangulate_test {
namespace {

double area(const Contours& contours) {
  double sum = 0;
  for (const auto& c : contours)
    for (std::size_t i = 0; i < c.size(); ++i) sum += cross(c[i], c[(i + 1) % c.size()]) / 2;
  return sum;
}

// The triangles' area. Every triangle must run counter-clockwise, so that none overlaps another if the sum equals the outline's area.
double covered(const Contours& contours) {
  std::vector<Vec2d> all;
  for (const auto& c : contours) all.insert(all.end(), c.begin(), c.end());
  const auto triangles = triangles_of(contours);
  EXPECT_TRUE(triangles);
  double sum = 0;
  for (const auto& t : triangles.value_or(std::vector<std::array<std::uint32_t, 3>>{})) {
    const double a = cross(all[t[1]] - all[t[0]], all[t[2]] - all[t[0]]) / 2;
    EXPECT_GT(a, 0);
    sum += a;
  }
  return sum;
}

std::vector<Vec2d> star(int points, double inner, double outer, Vec2d middle, double sign = 1) {
  std::vector<Vec2d> result;
  for (int i = 0; i < 2 * points; ++i) {
    const double angle = sign * 3.14159265358979324 * i / points, r = i % 2 == 0 ? outer : inner;
    result.push_back(middle + Vec2d{std::cos(angle), std::sin(angle)} * r);
  }
  return result;
}

TEST(ViewTriangles, CoverStarsAndTheirHoles) {
  for (const int points : {3, 5, 20}) {
    const Contours plain = {star(points, 0.3, 1, {2, -1})};
    EXPECT_NEAR(covered(plain), area(plain), 1e-13);
  }
  const Contours square = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}};
  Contours holes = square;
  for (const Vec2d m : {Vec2d{1, 1}, Vec2d{3, 1}, Vec2d{2, 3}, Vec2d{1, 3}}) holes.push_back(star(4, 0.2, 0.4, m, -1));
  EXPECT_NEAR(covered(holes), area(holes), 1e-13);
}

TEST(ViewTriangles, CoverRandomOutlinesAroundAPoint) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> radius(0.2, 1);
  for (int trial = 0; trial < 200; ++trial) {
    Contours contours(1);
    const int corners = 3 + trial % 30;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979324 * i / corners;
      contours[0].push_back(Vec2d{std::cos(angle), std::sin(angle)} * radius(random));
    }
    EXPECT_NEAR(covered(contours), area(contours), 1e-13) << trial;
  }
}

// A triangle that a round body enters through one side: the corners on that side are on it to rounding only.
TEST(ViewTriangles, CoverTrianglesThatAreCutThroughASide) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-1, 1), part(0.05, 0.95);
  for (int trial = 0; trial < 1000; ++trial) {
    Vec2d a{place(random), place(random)}, b{place(random), place(random)}, c{place(random), place(random)};
    if (cross(b - a, c - a) < 0) std::swap(b, c);
    const double height = cross(b - a, c - a) / length(b - a);
    if (height < 0.1) continue;
    const double first = part(random), second = part(random), begin = std::min(first, second), end = std::max(first, second);
    const Vec2d from = a + (b - a) * begin, to = a + (b - a) * end, middle = (from + to) * 0.5;
    // Half an ellipse over the cut side, low enough to stay within the triangle.
    const Vec2d up{-(b - a).y / length(b - a), (b - a).x / length(b - a)};
    const double low = 0.4 * height * std::min(begin, 1 - end);
    Contours contours(1);
    contours[0] = {a, from};
    for (int k = 1; k < 24; ++k) {
      const double angle = 3.14159265358979324 * k / 24;
      contours[0].push_back(middle + (from - middle) * std::cos(angle) + up * (low * std::sin(angle)));
    }
    contours[0].insert(contours[0].end(), {to, b, c});
    ASSERT_TRUE(triangles_of(contours)) << trial;
    EXPECT_NEAR(covered(contours), area(contours), 1e-13) << trial;
  }
}

TEST(ViewTriangles, RefuseOutlinesThatCrossOrTouchThemselves) {
  EXPECT_FALSE(triangles_of({}));
  EXPECT_FALSE(triangles_of({{{0, 0}, {1, 0}}}));
  EXPECT_FALSE(triangles_of({{{0, 0}, {0, 1}, {1, 1}, {1, 0}}})) << "clockwise";
  EXPECT_FALSE(triangles_of({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}})) << "a bow tie";
  EXPECT_FALSE(triangles_of({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}})) << "a corner on an edge";
  EXPECT_FALSE(triangles_of({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{3, 1}, {3, 2}, {5, 1}}})) << "a hole over the edge";
  EXPECT_TRUE(triangles_of({{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}}})) << "a corner on a straight line is one";
}

}  // namespace
}  // namespace steradian::triangulate_test
