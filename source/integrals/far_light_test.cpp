// Elements that represent far lights: their values against exact ones and quadrature, and every bound against its error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "steradian/kernels.h"
#include "steradian/vector.h"

namespace steradian::far_light_test {
namespace {

using K = Kernels<double>;
using V = K::vec3;

double number(Real<double> x) { return x.v; }
Vec3d vector(const V& v) { return {v.x.v, v.y.v, v.z.v}; }
V to_kernel(Vec3d v) { return {v.x, v.y, v.z}; }

Vec3d element(Vec3d area, Vec3d r) { return vector(K().far_element_vector(to_kernel(area), to_kernel(r))); }
Vec3d ball(Vec3d r) { return vector(K().far_ball_vector(to_kernel(r))); }

// Node i of n on [-1, 1].
double chebyshev_node(int i, int n) { return std::cos(std::numbers::pi * (i + 0.5) / n); }

template <class F>
Vec3d interpolated(F f, int n, double x) {
  Vec3d sum{};
  for (int i = 0; i < n; ++i) {
    double basis = 1;
    for (int k = 0; k < n; ++k)
      if (k != i) basis *= (x - chebyshev_node(k, n)) / (chebyshev_node(i, n) - chebyshev_node(k, n));
    sum = sum + f(chebyshev_node(i, n)) * basis;
  }
  return sum;
}

Vec3d direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3d{normal(random), normal(random), normal(random)});
}

// A line past an element: places p + u t for t in [-reach, reach].
struct Line {
  Vec3d to, u, area;  // from the middle of the line to the element
  double reach, distance;
};
Line random_line(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Line line;
  line.to = direction(random) * 2;
  line.u = uniform(random) < 0.3 ? normalized(line.to) : direction(random);
  line.area = direction(random);
  line.reach = 0.05 + 1.4 * uniform(random);
  const double along = std::clamp(dot(line.to, line.u), -line.reach, line.reach);
  line.distance = length(line.to - line.u * along);
  return line;
}
// Irradiance without clamping, for a light that certainly faces the line.
Vec3d at(const Line& line, double t) {
  const Vec3d r = line.to - line.u * (t * line.reach);
  const double r2 = dot(r, r);
  return r * (-dot(line.area, r) / (r2 * r2));
}

double grazing(const Line& line, Vec3d eye, double t) {
  const Vec3d p = line.u * (t * line.reach), l = normalized(line.to - p), v = normalized(eye - p);
  return number(K().lambert_grazing(to_kernel(l), to_kernel(v)));
}

// The unit square at height 1 that shines down, as its elements or by Gauss' rule of 24 points a side.
Vec3d square(Vec3d p) {
  constexpr int kSide = 400;
  Vec3d sum{};
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      sum = sum + element({0, -1.0 / (kSide * kSide), 0}, Vec3d{(i + 0.5) / kSide - 0.5, 1, (j + 0.5) / kSide - 0.5} - p);
  return sum;
}

}  // namespace

// The midpoint rule's error is at most 2 (2 / 24) 3 h^2 of the value here: 3.2e-6 at distance 1 and less beyond.
TEST(FarLight, ElementsAddUpToTheSquare) {
  const struct {
    double x;
    Vec3d e;
  } cases[] = {{0, {0, 0.752274688454107481, 0}},
               {0.5, {-0.223346625828317752, 0.566645112049507263, 0}},
               {2, {-0.0818851890540902292, 0.0437426483154649286, 0}},
               {8, {-0.00190275610243785289, 0.000239067305633711979, 0}}};
  for (const auto& c : cases) EXPECT_LT(length(square({c.x, 0, 0}) - c.e), 3.2e-6) << "x " << c.x;
}

TEST(FarLight, ElementShinesToItsFrontOnly) {
  EXPECT_EQ(element({0, 0, 1}, {0, 0, 2}), (Vec3d{}));
  EXPECT_NEAR(element({0, 0, -1}, {0, 0, 2}).z, 0.25, 1e-15);
}

TEST(FarLight, OneElementIsWithinItsBound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double largest = 0;
  for (int n = 0; n < 400; ++n) {
    // A rectangle of half sides a and b, by Gauss' rule of 16 points a side in effect: midpoints, 40 a side.
    const Vec3d normal = direction(random), x = normalized(cross(normal, direction(random))), y = cross(normal, x);
    const double a = 0.05 + 0.3 * uniform(random), b = 0.05 + 0.3 * uniform(random);
    const Vec3d c = direction(random) * (0.8 + uniform(random));
    const double side = dot(normal, c) > 0 ? -1 : 1;
    constexpr int kSide = 40;
    Vec3d all{};
    double nearest = 1e9;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const Vec3d r = c + x * (a * ((2 * i + 1.0) / kSide - 1)) + y * (b * ((2 * j + 1.0) / kSide - 1));
        nearest = std::min(nearest, length(r));
        all = all + element(normal * (side * 4 * a * b / (kSide * kSide)), r);
      }
    // The rectangle is in front by construction: the plane does not pass through the receiver.
    const double one = number(K().far_error_of_one((a * a + b * b) / 3, nearest * nearest));
    const double error = length(element(normal * (side * 4 * a * b), c) - all) * nearest * nearest / (4 * a * b);
    EXPECT_LT(error, one * (1 + 1e-3)) << "a " << a << " b " << b;
    largest = std::max(largest, error / one);

    const double third = std::pow((a * a + b * b), 1.5), ra = a * a * 2 / 3, rb = b * b * 2 / 3;
    const double fourth = a * a * a * a / 5 + b * b * b * b / 5 + 2 * a * a * b * b / 9 + (ra * ra + rb * rb) / 2;
    Vec3d elements{};
    for (const Vec3d reach : {x * std::sqrt(ra), x * -std::sqrt(ra), y * std::sqrt(rb), y * -std::sqrt(rb)})
      elements = elements + element(normal * (side * a * b), c + reach);
    const double four = number(K().far_error_of_four(2 * third, fourth, K().mask_all(), nearest * nearest));
    EXPECT_LT(length(elements - all) * nearest * nearest / (4 * a * b), four + 1e-4 * one) << "a " << a << " b " << b;
  }
  std::printf("largest error over bound of one element %.2f\n", largest);
  EXPECT_GT(largest, 0.3);  // a much larger bound would cost elements
}

// A rectangle that the plane z = 0 of the receiver at the origin cuts, or nearly.
TEST(FarLight, OneElementAcrossTheHorizonIsWithinItsBound) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double largest = 0;
  for (int n = 0; n < 1000; ++n) {
    const Vec3d normal = direction(random), x = normalized(cross(normal, direction(random))), y = cross(normal, x);
    const double a = 0.2 + 0.15 * uniform(random), b = 0.2 + 0.15 * uniform(random);
    Vec3d c = direction(random) * (1.5 + uniform(random) * 0.5);
    c.z = 0.3 * uniform(random);
    const double side = dot(normal, c) > 0 ? -1 : 1;
    constexpr int kSide = 60;
    double all = 0, top = 0, nearest = 1e9;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const Vec3d r = c + x * (a * ((2 * i + 1.0) / kSide - 1)) + y * (b * ((2 * j + 1.0) / kSide - 1));
        nearest = std::min(nearest, length(r));
        top = std::max(top, r.z);
        all += std::max(element(normal * (side * 4 * a * b / (kSide * kSide)), r).z, 0.0);
      }
    const double one = std::max(element(normal * (side * 4 * a * b), c).z, 0.0),
                 up = std::sqrt((x.z * x.z * a * a + y.z * y.z * b * b) / 3);
    const double bound = number(K().far_error_across_horizon(top, up, std::sqrt((a * a + b * b) / 3), nearest));
    const double error = std::abs(one - all) * nearest * nearest / (4 * a * b);
    EXPECT_LT(error, bound * 1.002 + 1e-6) << "height " << c.z;  // the midpoint rule's own
    if (bound > 1e-3) largest = std::max(largest, error / bound);
  }
  std::printf("largest error over bound across the horizon %.2f\n", largest);
  EXPECT_GT(largest, 0.2);
}

TEST(FarLight, InterpolationIsWithinItsBound) {
  std::mt19937 random(2);
  for (int nodes = 1; nodes <= 8; ++nodes) {
    double largest = 0;
    for (int n = 0; n < 3000; ++n) {
      const Line line = random_line(random);
      if (line.distance < 0.2) continue;
      const double bound = number(K().far_error_of_nodes(nodes, line.reach, line.distance)) / (line.distance * line.distance);
      const auto vector_at = [&](double t) { return at(line, t); };
      const auto ball_at = [&](double t) { return ball(line.to - line.u * (t * line.reach)); };
      for (const double t : {-1.0, -0.6, -0.1, 0.0, 0.35, 0.8, 1.0}) {
        const double error =
            std::max(length(interpolated(vector_at, nodes, t) - vector_at(t)), length(interpolated(ball_at, nodes, t) - ball_at(t)));
        EXPECT_LT(error, bound + 1e-13) << nodes << " nodes";
        largest = std::max(largest, error / bound);
      }
    }
    std::printf("%d nodes: largest error over bound %.2f\n", nodes, largest);
    EXPECT_GT(largest, 0.2) << nodes;
  }
}

TEST(FarLight, InterpolationUnderFresnelIsWithinItsBound) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int nodes = 1; nodes <= 5; ++nodes) {
    double largest = 0;
    for (int n = 0; n < 3000; ++n) {
      Line line = random_line(random);
      line.reach *= 0.3;
      const double along = std::clamp(dot(line.to, line.u), -line.reach, line.reach);
      line.distance = length(line.to - line.u * along);
      // Half of the eyes are about opposite to the element, where the weight is large.
      const Vec3d away = uniform(random) < 0.5 ? normalized(line.to * -0.5 + direction(random) * 0.6) : direction(random);
      const Vec3d eye = away * (0.7 + 3 * uniform(random));
      double least = 1, view_distance = 1e9;
      for (int i = 0; i <= 64; ++i) {
        const Vec3d p = line.u * (line.reach * (i / 32.0 - 1));
        least = std::min(least, 0.5 + 0.5 * dot(normalized(line.to - p), normalized(eye - p)));
        view_distance = std::min(view_distance, length(eye - p));
      }
      const double share = number(K().far_error_of_grazing_nodes(nodes, line.reach, line.distance, view_distance, least - 1e-3));
      const double bound = share / (line.distance * line.distance);
      const auto weighted = [&](double t) { return at(line, t) * grazing(line, eye, t); };
      for (const double t : {-1.0, -0.5, 0.1, 0.7, 1.0}) {
        const double error = length(interpolated(weighted, nodes, t) - weighted(t));
        EXPECT_LT(error, bound + 1e-13) << nodes << " nodes";
        largest = std::max(largest, error / bound);
      }
    }
    std::printf("%d nodes under Fresnel: largest error over bound %.3f\n", nodes, largest);
    EXPECT_GT(largest, 0.003) << nodes;
  }
}

TEST(FarLight, GrazingIsWithinItsBounds) {
  for (int i = 0; i < 200; ++i) {
    const double half = std::numbers::pi / 2 * (i + 0.5) / 200, c = std::cos(half), step = 1e-5;
    const auto weight = [](double angle) {
      const double x = 1 - std::cos(angle / 2);
      return std::pow(x, 5);
    };
    const auto bounds = K().far_grazing(c);
    EXPECT_NEAR(number(bounds.x), weight(2 * half), 1e-12);
    EXPECT_NEAR(number(bounds.y), (weight(2 * half + step) - weight(2 * half - step)) / (2 * step), 1e-6);
  }
}

}  // namespace steradian::far_light_test
