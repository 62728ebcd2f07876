#include "steradian/polygon_derivatives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <vector>

#include "night.h"
#include "steradian/error.h"
#include "steradian/phong.h"
#include "steradian/radiance.h"
#include "steradian/reference.h"
#include "steradian/vector.h"

namespace steradian::polygon_derivatives_test {
namespace {

// Central differences at two steps. Their distance bounds the truncation of the smaller one (three times it, where the
// function is smooth); the other part of the tolerance is the rounding of the two values.
struct Differences {
  double value, tolerance;
};

Differences central(const std::function<double(double)>& f) {
  const double h = 1e-5;
  const double fine = (f(h) - f(-h)) / (2 * h), coarse = (f(2 * h) - f(-2 * h)) / (4 * h);
  return {fine, std::fabs(fine - coarse) + 1e-13 / h};
}

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}
Vec3d vector(std::mt19937_64& random) {
  const double x = uniform(random, -1, 1), y = uniform(random, -1, 1), z = uniform(random, -1, 1);
  return {x, y, z};
}

// A triangle with a triangular hole, two-sided, at random about the point: often across the horizon.
PolygonLight random_light(std::mt19937_64& random) {
  PolygonLight light;
  for (int i = 0; i < 3; ++i) light.vertices.push_back(vector(random) * 2.0 + Vec3d{0.0, 0.0, 1.5});
  const Vec3d middle = (light.vertices[0] + light.vertices[1] + light.vertices[2]) / 3.0;
  light.holes.emplace_back();
  for (const Vec3d& v : light.vertices) light.holes[0].push_back(middle + (v - middle) * 0.3);
  light.two_sided = true;
  return light;
}

double& component(Vec3d& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

using Value = std::function<double(const PolygonLight&, Vec3d, Vec3d)>;

void check(const char* what, const std::function<double(double)>& f, double derivative) {
  const Differences d = central(f);
  EXPECT_NEAR(derivative, d.value, d.tolerance) << what;
}

void check_all(const LightDerivatives& got, const PolygonLight& light, Vec3d p, Vec3d n, const Value& value) {
  EXPECT_NEAR(got.value, value(light, p, n), 1e-13);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < got.vertices.size(); ++i) {
      Vec3d derivative = got.vertices[i];
      check(
          "vertex",
          [&](double h) {
            PolygonLight moved = light;
            Vec3d& v = i < 3 ? moved.vertices[i] : moved.holes[0][i - 3];
            component(v, axis) += h;
            return value(moved, p, n);
          },
          component(derivative, axis));
    }
    Vec3d by_position = got.position, by_normal = got.normal;
    check(
        "position",
        [&](double h) {
          Vec3d q = p;
          component(q, axis) += h;
          return value(light, q, n);
        },
        component(by_position, axis));
    check(
        "normal",
        [&](double h) {
          Vec3d m = n;
          component(m, axis) += h;
          return value(light, p, normalized(m));
        },
        component(by_normal, axis));
  }
}

// A vertex moved by 2e-5 would leave the plane further than prepare_polygon allows for a light of this size. The triangles are therefore
// walked separately: the outline minus the hole, each flat for any move.
double outline_less_hole(const std::function<double(const PreparedPolygon&)>& integral, const PolygonLight& light) {
  PolygonLight outline = light, hole = light;
  outline.holes.clear();
  hole.vertices = light.holes[0];
  hole.holes.clear();
  return integral(prepare_polygon(outline)) - integral(prepare_polygon(hole));
}

}  // namespace

TEST(PolygonDerivatives, OfIrradianceAgreeWithCentralDifferences) {
  std::mt19937_64 random(1);
  int lit = 0;
  for (int round = 0; round < 200; ++round) {
    const PolygonLight light = random_light(random);
    const Vec3d p = vector(random) * 0.3, n = normalized(vector(random));
    const LightDerivatives got = polygon_irradiance_derivatives(light, p, n);
    lit += got.value > 1e-3;
    EXPECT_NEAR(dot(got.normal, n), 0.0, 1e-12) << "a derivative along the normal";
    check_all(got, light, p, n, [](const PolygonLight& l, Vec3d q, Vec3d m) {
      return outline_less_hole([&](const PreparedPolygon& prepared) { return polygon_irradiance(prepared, q, m); }, l);
    });
  }
  EXPECT_GE(lit, 100) << "lights that give light";
}

TEST(PolygonDerivatives, OfSolidAngleAgreeWithCentralDifferences) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 200; ++round) {
    const PolygonLight light = random_light(random);
    const Vec3d p = vector(random) * 0.3;
    check_all(polygon_solid_angle_derivatives(light, p), light, p, {0, 0, 1}, [](const PolygonLight& l, Vec3d q, Vec3d) {
      return outline_less_hole([&](const PreparedPolygon& prepared) { return polygon_solid_angle(prepared, q); }, l);
    });
  }
}

// Derivatives of a lobe's radiance by the vertices. The last step of the poles' iteration is at most 1e-8 of a pole's height. A derivative
// may lack that fraction of the part that depends on the poles, which is of the order of the derivatives of the whole light.
using Radiance = std::function<Vec3d(const PreparedPolygon&, const ShadingPoint&)>;
using Derivatives = std::function<RadianceDerivatives(const PolygonLight&, const ShadingPoint&)>;

struct Variables {
  std::size_t first = 0, last = 6;  // the vertices, the point, the normal, the view
};

void check_radiance(const Material& material, const Radiance& radiance, const Derivatives& derivatives, double share,
                    Variables variables = {}) {
  std::mt19937_64 random(7);
  int lit = 0, jumps = 0;
  for (int i = 0; i < 60; ++i) {
    PolygonLight light = random_light(random);
    light.holes.clear();
    light.radiance = {2, 1, 0.5};
    const ShadingPoint at = {vector(random) * 0.3, {0, 0, 1}, normalized(vector(random) + Vec3d{0, 0, 1.5})};
    const RadianceDerivatives got = derivatives(light, at);
    ASSERT_EQ(got.vertices.size(), 3u);
    const std::array<Vec3d, 3> got_by_position = by_position(got);
    double size = length(got.normal[0]);
    for (const auto& vertex : got.vertices)
      for (const Vec3d& d : vertex) size = std::max(size, length(d));
    lit += size > 0;
    for (std::size_t v = variables.first; v < variables.last; ++v)
      for (int axis = 0; axis < 3; ++axis)
        for (int channel : {0, 2}) {
          const Differences d = central([&](double h) {
            PolygonLight moved = light;
            ShadingPoint moved_at = at;
            component(v < 3 ? moved.vertices[v] : v == 3 ? moved_at.position : v == 4 ? moved_at.normal : moved_at.view, axis) += h;
            moved_at.normal = normalized(moved_at.normal);
            moved_at.view = normalized(moved_at.view);
            Vec3d value = radiance(prepare_polygon(moved), moved_at);
            return component(value, channel);
          });
          // GGX's number of nodes is a step function. If it changes within h, the differences meet a jump, and show it by disagreeing with
          // each other.
          if (d.tolerance > 0.01 * size + 1e-7) {
            ++jumps;
            continue;
          }
          Vec3d derivative = (v < 3    ? got.vertices[v]
                              : v == 3 ? got_by_position
                              : v == 4 ? got.normal
                                       : got.view)[static_cast<std::size_t>(channel)];
          EXPECT_NEAR(component(derivative, axis), d.value, d.tolerance + share * size)
              << name_of(material.brdf) << ", light " << i << ", vertex " << v << ", axis " << axis << ", channel " << channel;
        }
  }
  EXPECT_GT(lit, 20);
  EXPECT_LE(jumps, lit * 30 / 100) << "more than one in a hundred";
}

// All are derivatives of the true integral.
TEST(PolygonDerivatives, OfPhongAndGgxAgreeWithCentralDifferences) {
  const auto truth = [](const Material& m) {
    return [&m](const PreparedPolygon& l, const ShadingPoint& at) {
      return reference_radiance(l, at, m, {.relative_error = 1e-12, .absolute_error = 1e-15}).radiance;
    };
  };
  for (const double exponent : test::by_day_or_night<std::vector<double>>({4}, {4, 0.5, 60})) {
    const Material phong{.brdf = Brdf::phong, .albedo = {0.5, 0.6, 0.7}, .exponent = exponent};
    const auto derivatives = [&](const PolygonLight& l, const ShadingPoint& at) { return radiance_derivatives(l, at, phong); };
    // The quadrature is off by 1e-12 of the value, which is 1e-7 over the step of the differences.
    check_radiance(phong, truth(phong), derivatives, 1e-6);
  }
  Material ggx{.brdf = Brdf::ggx};
  ggx.f0 = {0.04, 0.5, 0.9};
  for (const double alpha_y : test::by_day_or_night<std::vector<double>>({0.5}, {0.5, 0.3})) {
    ggx.alpha_x = 0.3;
    ggx.alpha_y = alpha_y;
    ggx.tangent = alpha_y == 0.3 ? Vec3d{} : Vec3d{0.8, 0.5, 0.6};
    const auto high = [&](const PolygonLight& l, const ShadingPoint& at) { return radiance_derivatives(l, at, ggx, Quality::high); };
    // The rule of 8 nodes twice an edge is within 1e-4 of the largest one.
    check_radiance(ggx, truth(ggx), high, 1e-4, {0, 4});
    // Inside the light, shadowing and Fresnel have the error of the cubature's mean: 0.3 %.
    check_radiance(ggx, truth(ggx), high, 3e-3, {4, 6});
  }
}

TEST(PolygonDerivatives, OfTransformedCosinesAgreeWithCentralDifferences) {
  Material ggx{.brdf = Brdf::ggx};
  ggx.f0 = {0.04, 0.5, 0.9};
  for (LtcMethod method : {LtcMethod::classic, LtcMethod::compact})
    for (double alpha : {0.1, 0.5}) {
      ggx.alpha_x = ggx.alpha_y = alpha;
      check_radiance(
          ggx, [&](const PreparedPolygon& l, const ShadingPoint& at) { return ltc_radiance(method, l, at, ggx); },
          [&](const PolygonLight& l, const ShadingPoint& at) { return ltc_radiance_derivatives(method, l, at, ggx); }, 0);
    }
  EXPECT_THROW(ltc_radiance_derivatives(LtcMethod::clipless, PolygonLight{}, {}, ggx), Error);
  ggx.alpha_y = 0.2;
  EXPECT_THROW(ltc_radiance_derivatives(LtcMethod::classic, PolygonLight{}, {}, ggx), Error);
}

// Moving light and point together changes nothing, so the derivatives add up to zero.
TEST(PolygonDerivatives, AddUpToZeroUnderTranslation) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 200; ++round) {
    const LightDerivatives d = polygon_irradiance_derivatives(random_light(random), vector(random) * 0.3, {0, 0, 1});
    Vec3d sum = d.position;
    double size = length(d.position);
    for (const Vec3d& v : d.vertices) {
      sum += v;
      size += length(v);
    }
    EXPECT_LE(length(sum), 1e-12 * (1 + size));
  }
}

TEST(PolygonDerivatives, AreZeroBehindAndForDroppedVertices) {
  PolygonLight light;
  light.vertices = {{0, 0, 1}, {1, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};  // lit side: +z, away from the point
  const LightDerivatives behind = polygon_irradiance_derivatives(light, {0, 0, 0}, {0, 0, 1});
  EXPECT_EQ(behind.value, 0);
  ASSERT_EQ(behind.vertices.size(), 5u);
  for (const Vec3d& v : behind.vertices) EXPECT_EQ(length(v), 0);
  const LightDerivatives lit = polygon_irradiance_derivatives(light, {0, 0, 2}, {0, 0, -1});
  EXPECT_GT(lit.value, 0);
  EXPECT_GT(length(lit.vertices[1]), 0);
  EXPECT_EQ(length(lit.vertices[2]), 0);
}

// Prints the cost of derivatives. 18 derivatives of a quad by central differences take 36 evaluations: these must be cheaper. Small lights
// move in the light's plane: no noise, and no large bias where the light is small against the lobe. Errors are fractions of the value over
// the size; the values themselves have an error of a fraction of (size / lobe)^3.
TEST(PolygonDerivatives, OfSmallLightsAreThoseOfTheirValues) {
  std::mt19937_64 random(23);
  for (const Brdf brdf : {Brdf::lambert, Brdf::phong, Brdf::ggx})
    for (const double size : {0.1, 1e-2, 1e-3, 1e-4, 1e-6}) {
      double worst = 0;
      for (int k = 0; k < 4; ++k) {
        const double view = uniform(random, 0.2, 1);
        const ShadingPoint at = {{}, {0, 0, 1}, {std::sin(view), 0, std::cos(view)}};
        Material m;
        m.brdf = brdf;
        m.exponent = 30;
        m.alpha_x = m.alpha_y = 0.2;
        const Vec3d to = normalized(Vec3d{0.05 - at.view.x, 0, at.view.z});
        const Frame plane = Frame::from_normal(normalized(vector(random) * 0.3 - to));
        PolygonLight light;
        for (const double x : {-1.0, 1.0}) light.vertices.push_back(to + (plane.x * x - plane.y) * size);
        for (const double x : {1.0, -1.0}) light.vertices.push_back(to + (plane.x * x + plane.y) * size);
        const auto value = [&](std::size_t i, Vec3d by) {
          PolygonLight moved = light;
          moved.vertices[i] += by;
          return radiance(moved, at, m).radiance.x;
        };
        const RadianceDerivatives d = radiance_derivatives(light, at, m, Quality::normal);
        for (std::size_t i = 0; i < 4; ++i)
          for (const Vec3d along : {plane.x, plane.y}) {
            const Vec3d by = along * (1e-3 * size);
            const double difference = (value(i, by) - value(i, -by)) / (2e-3 * size);
            worst = std::max(worst, std::fabs(dot(d.vertices[i][0], along) - difference) * size / value(i, {}));
          }
      }
      EXPECT_LT(worst, 2e-2 * size + 1e-13 / size + 1e-6) << name_of(brdf) << " size " << size;
      std::printf("%s, size %g: largest difference %.1e of the value over the size\n", name_of(brdf), size, worst);
    }
}

TEST(PolygonDerivatives, CostLessThanCentralDifferences) {
  PolygonLight light;
  light.vertices = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  const PreparedPolygon prepared = prepare_polygon(light);
  const auto time = [](const auto& f) {
    double fastest = 1e30;  // of many short runs: time taken by other programs does not count
    for (int run = 0; run < 100; ++run) {
      const auto start = std::chrono::steady_clock::now();
      double sum = 0;
      for (int i = 0; i < 100; ++i) sum += f(Vec3d{1e-3 * i, 0, 0});
      EXPECT_GT(sum, 0);
      const auto passed = std::chrono::steady_clock::now() - start;
      fastest = std::min(fastest, std::chrono::duration<double, std::nano>(passed).count() / 100);
    }
    return fastest;
  };
  const double plain = time([&](Vec3d p) { return polygon_irradiance(prepared, p, {0, 0, 1}); });
  const double with = time([&](Vec3d p) { return polygon_irradiance_derivatives(light, p, {0, 0, 1}).value; });
  std::printf("quad irradiance in double: %.0f ns, with its 18 derivatives %.0f ns, ratio %.1f\n", plain, with, with / plain);
#ifdef NDEBUG
  EXPECT_LT(with, 37 * plain);
#endif
}

}  // namespace steradian::polygon_derivatives_test
