// Tubes in `steradian eval`: form factors, every lobe against the reference, lines against integrals along them, degenerate cases and
// invalid input.
#include "integrals/curved_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "eval/answer.h"
#include "lobes/lobe.h"
#include "steradian/capsule_light.h"
#include "support/random_configurations.h"

namespace steradian::eval::capsule_light_test {
namespace {

using reference::Random;
using reference::random_direction;

Material material_of(Brdf brdf) {
  Material m;
  m.brdf = brdf;
  return m;
}
Material ggx(double alpha) {
  Material m = material_of(Brdf::ggx);
  m.alpha_x = m.alpha_y = alpha;
  return m;
}

Query query_of(const Light& light, const ShadingPoint& at, const Material& m, Method method, Quality quality) {
  Query q;
  q.lights = {light};
  q.position = at.position;
  q.normal = at.normal;
  q.view = at.view;
  q.materials = {m};
  q.method = method;
  q.quality = quality;
  return q;
}

Answer ask(const Light& light, const ShadingPoint& at, const Material& m, Method method = Method::automatic,
           Quality quality = Quality::normal) {
  return evaluate(query_of(light, at, m, method, quality));
}

AreaLight tube(Vec3d a, Vec3d b, double radius) { return {capsule_or_line(a, b, radius)}; }
Light sphere(Vec3d center, double radius) { return AreaLight{Ellipsoid{center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}; }

struct Case {
  const char* name;
  Material material;
  Method method;
  Quality quality;
  double error;  // error of the method on polygons (docs/measured/accuracy.md, docs/theory/moments.md) plus 0.01 for K = 12, 0.002 for 16
};
std::vector<Case> cases() {
  Material phong = material_of(Brdf::phong), sharp = phong, blinn = material_of(Brdf::blinn_phong);
  phong.exponent = 10;
  sharp.exponent = 1000;
  blinn.exponent = 100;
  Material bare = ggx(0.1);
  bare.shadowing = false;
  Material beckmann = ggx(0.2);
  beckmann.brdf = Brdf::beckmann;
  return {{"lambert", material_of(Brdf::lambert), Method::exact, Quality::normal, 1e-12},
          {"phong 10", phong, Method::automatic, Quality::normal, 1.3e-3 + 0.01},
          {"phong 1000", sharp, Method::automatic, Quality::high, 4.5e-4 + 0.002},
          {"phong exact", sharp, Method::exact, Quality::normal, 1e-10},
          {"ggx", ggx(0.4), Method::automatic, Quality::normal, 0.005 + 0.01},
          {"ggx high", ggx(0.1), Method::automatic, Quality::high, 0.002 + 0.005},
          {"ggx ltc", ggx(0.3), Method::ltc, Quality::normal, 0.05},
          {"ggx draft", ggx(0.3), Method::automatic, Quality::draft, 0.05},
          {"ggx exact", bare, Method::exact, Quality::normal, 1e-6},
          {"blinn-phong", blinn, Method::automatic, Quality::normal, 0.01 + 0.01},
          {"beckmann", beckmann, Method::automatic, Quality::high, 0.003 + 0.005}};
}

const ShadingPoint kFloor{{}, {0, 1, 0}, normalized(Vec3d{0.3, 1, 0})};

// A view whose mirror image points near that direction.
ShadingPoint looking_near(Random& random, Vec3d direction) {
  const Vec3d mirror = normalized(direction + random_direction(random) * 0.3 + Vec3d{0, 0.3, 0});
  return {{}, {0, 1, 0}, normalized(Vec3d{-mirror.x, std::max(mirror.y, 0.1), -mirror.z})};
}

}  // namespace

TEST(EvalCapsule, EveryLobeAgreesWithTheReference) {
  for (const Case& c : cases()) {
    Random random(11);
    double worst = 0, largest = 0, bound = 0;
    for (int i = 0; i < 4; ++i) {
      Vec3d direction = random_direction(random);
      direction.y = std::fabs(direction.y) * (i == 3 ? 0.1 : 1.0);  // the last line crosses the horizon
      const Vec3d half = random_direction(random) * random.uniform(0.1, 0.8);
      const AreaLight light = tube(direction - half, direction + half, random.uniform(0.05, 0.19));
      const ShadingPoint at = looking_near(random, direction);
      const Answer truth = ask(light, at, c.material, Method::reference);
      worst = std::max(worst, std::fabs(ask(light, at, c.material, c.method, c.quality).radiance.x - truth.radiance.x));
      largest = std::max(largest, truth.radiance.x);
      bound = std::max(bound, *truth.bound);
    }
    EXPECT_LE(worst, c.error + bound) << c.name;
    EXPECT_GT(largest, 0.02) << c.name;
    EXPECT_LT(bound, 1e-6) << c.name << ": the reference must know its value";
    std::printf("%-12s largest error %.1e, bound of the reference %.1e\n", c.name, worst, bound);
  }
}

TEST(EvalCapsule, WithoutLengthIsASphere) {
  for (const Case& c : cases()) {
    const Vec3d center{0.5, 1, 0.2};
    const double ball = ask(sphere(center, 0.4), kFloor, c.material, c.method, c.quality).radiance.x;
    const double capsule = ask(tube(center, center, 0.4), kFloor, c.material, c.method, c.quality).radiance.x;
    EXPECT_NEAR(capsule, ball, 2 * c.error + 1e-12) << c.name;
  }
}

TEST(EvalCapsule, SampledAgreesWithinItsStandardError) {
  for (double radius : {0.3, 0.0}) {
    const AreaLight light = tube({-0.5, 1, 0}, {1, 1.5, 0.3}, radius);
    const Answer truth = ask(light, kFloor, ggx(0.3), Method::reference), sampled = ask(light, kFloor, ggx(0.3), Method::sampled);
    EXPECT_NEAR(sampled.radiance.x, truth.radiance.x, 4 * *sampled.standard_error) << radius;
    EXPECT_GT(truth.radiance.x, 0.01) << radius;
  }
}

TEST(EvalLine, IsTheIntegralOfTheLobeAlongIt) {
  // INT lobe(direction) sin(angle to the line) / d^2 ds: the integral along the line, without strip or polygon.
  for (const Case& c : cases()) {
    Random random(12);
    double worst = 0, largest = 0;
    for (int i = 0; i < 6; ++i) {
      Vec3d direction = random_direction(random);
      direction.y = std::fabs(direction.y);
      const Vec3d half = random_direction(random) * random.uniform(0.1, 0.8);
      Vec3d a = direction - half, b = direction + half;
      const AreaLight light = tube(a, b, 0);
      // The midpoint rule is inaccurate at a step, so the line is clipped to the part above the horizon.
      if (a.y < 0) a = a + (b - a) * (a.y / (a.y - b.y));
      if (b.y < 0) b = b + (a - b) * (b.y / (b.y - a.y));
      const ShadingPoint at = looking_near(random, direction);
      const Frame frame = Frame::from_normal_and_tangent(at.normal, c.material.tangent);
      const lobes::Lobe lobe(c.material, frame.to_local(at.view));
      double sum = 0;
      constexpr int kSteps = 20000;
      for (int k = 0; k < kSteps; ++k) {
        const Vec3d p = a + (b - a) * ((k + 0.5) / kSteps);
        const double d = length(p);
        sum += lobe.radiance(lobe.evaluate(frame.to_local(p / d))).x * length(cross(b - a, p / d)) / (d * d) / kSteps;
      }
      const Answer truth = ask(light, at, c.material, Method::reference);
      EXPECT_NEAR(truth.radiance.x, sum, *truth.bound + 1e-6 * (1 + sum)) << c.name;
      worst = std::max(worst, std::fabs(ask(light, at, c.material, c.method, c.quality).radiance.x - sum) / (1 + sum));
      largest = std::max(largest, sum);
    }
    EXPECT_GT(largest, 0.01) << c.name;
    // The second order of the strip is negligible. The error of a lobe is that of its integral over a width, in units of 1/m.
    EXPECT_LE(worst, 2 * c.error + 1e-6) << c.name;
    std::printf("%-12s largest error over 1 + value %.1e\n", c.name, worst);
  }
}

TEST(EvalLine, IsTheLimitOfThinCapsules) {
  // Radii on both sides of the limit below which a capsule counts as a line.
  for (const Case& c : cases()) {
    const Vec3d a{-0.5, 1, 0.2}, b{0.7, 1.2, -0.3};
    const double line = ask(tube(a, b, 0), kFloor, c.material, c.method, c.quality).radiance.x;
    for (double radius : {1e-4, 3e-7, 3e-8, 1e-12}) {
      const double over_width = ask(tube(a, b, radius), kFloor, c.material, c.method, c.quality).radiance.x / (2 * radius);
      EXPECT_NEAR(over_width, line, 0.01 * line) << c.name << ", radius " << radius;
    }
    EXPECT_GT(line, 1e-6) << c.name;
  }
}

TEST(EvalLine, ScalesWithTheInverseOfLengths) {
  const double truth = ask(tube({1, 2, 2}, {2, 1, 1}, 0), kFloor, ggx(0.3)).radiance.x;
  for (int power : {-400, -40, 40, 400}) {
    const double s = std::ldexp(1.0, power);
    EXPECT_NEAR(ask(tube(Vec3d{1, 2, 2} * s, Vec3d{2, 1, 1} * s, 0), kFloor, ggx(0.3)).radiance.x * s, truth, 1e-13) << power;
    EXPECT_NEAR(ask(tube(Vec3d{1, 2, 2} * s, Vec3d{2, 1, 1} * s, 0.1 * s), kFloor, ggx(0.3)).radiance.x,
                ask(tube({1, 2, 2}, {2, 1, 1}, 0.1), kFloor, ggx(0.3)).radiance.x, 1e-13)
        << power;
  }
}

TEST(EvalCapsule, ATinyOneIsAPointLight) {
  for (double size : {1e-6, 1e-7, 1e-8, 1e-12}) {
    const Vec3d center{1, 2, 2}, half = Vec3d{0.3, -0.1, 0.2} * size;
    const double sine = length(cross(normalized(half), normalized(center)));
    const double area = 2 * length(half) * 2 * (0.2 * size) * sine + std::numbers::pi * 0.04 * size * size;
    const double expected = ask(PointLight{center, {area, area, area}}, kFloor, ggx(0.3)).radiance.x;
    EXPECT_NEAR(ask(tube(center - half, center + half, 0.2 * size), kFloor, ggx(0.3)).radiance.x / expected, 1, 1e-3) << size;
  }
}

TEST(EvalCapsule, InsideBelowAndNoWidthGiveZero) {
  const AreaLight dark[] = {tube({-1, 0.5, 0}, {1, 0.5, 0}, 0.6),                                 // inside
                            tube({-1, 0, 0}, {1, 0, 0}, 0.1),                                     // on the axis, inside
                            tube({-1, 0, 0}, {1, 0, 0}, 0),                                       // through the point
                            tube({0, 0, 0}, {0, 0, 0}, 0),        tube({0, 1, 0}, {0, 1, 0}, 0),  // a point
                            tube({0, 1, 0}, {0, 2, 0}, 0),                                        // towards the point
                            tube({-1, -2, 0}, {1, -2, 0}, 1),                                     // below the horizon
                            tube({-1, -2, 0}, {1, -2, 0}, 0)};
  for (const AreaLight& light : dark)
    for (const Material& m : {material_of(Brdf::lambert), ggx(0.3)})
      for (Method method : {Method::automatic, Method::reference, Method::sampled})
        EXPECT_EQ(ask(light, kFloor, m, method).radiance, Vec3d{}) << name_of(m.brdf) << " light " << (&light - dark);
}

TEST(EvalCapsule, EveryMethodGivesFiniteNumbersWhereverThePointIs) {
  Random random(13);
  for (int i = 0; i < 300; ++i) {
    const Vec3d a = random_direction(random) * std::pow(10, random.uniform(-2, 2));
    const Vec3d b = i % 3 == 0 ? a * random.uniform(0, 3) : random_direction(random) * std::pow(10, random.uniform(-2, 2));
    const double radius = i % 4 == 0 ? 0 : std::pow(10, random.uniform(-9, 1));
    for (const Case& c : cases()) {
      if (c.method == Method::exact && c.material.brdf != Brdf::lambert) continue;             // 1024 vertices: slow
      const Answer answer = ask(tube(a, b, radius), kFloor, c.material, c.method, c.quality);  // throws if not finite
      EXPECT_GE(answer.radiance.x, 0.0) << c.name << " " << i;
      if (c.material.brdf == Brdf::lambert && radius > 0) {
        EXPECT_LE(answer.radiance.x, 1.0) << i;
      }
    }
  }
}

TEST(EvalCapsule, ReadsItsKeysAndNamesWrongOnes) {
  QueryReader reader;
  const auto read = [&](const std::string& light) {
    const std::string line = R"({"light": )" + light + R"(, "position": [0,0,0], "normal": [0,1,0], "material": {"brdf": "lambert"}})";
    std::string out, padded = line + std::string(kQueryPadding, ' ');
    answer_line(reader, std::string_view(padded).substr(0, line.size()), out);
    return out;
  };
  const double expected = capsule_irradiance({{-1, 2, 0}, {1, 2, 0}, 0.25}, {}, {0, 1, 0}) / std::numbers::pi * 3;
  const std::string out = read(R"({"type": "capsule", "ends": [[-1,2,0],[1,2,0]], "radius": 0.25, "radiance": 3})");
  EXPECT_NEAR(std::stod(out.substr(out.find('[') + 1)), expected, 1e-15) << out;
  const auto refuses = [&](const char* light, const char* problem) {
    EXPECT_NE(read(light).find(problem), std::string::npos) << read(light);
  };
  refuses(R"({"type": "capsule", "ends": [[-1,2,0],[1,2,0]]})", "light.radius: missing");
  refuses(R"({"type": "capsule", "ends": [[-1,2,0]], "radius": 1})", "light.ends: expected 2 points, found 1");
  refuses(R"({"type": "capsule", "ends": 7, "radius": 1})", "light.ends: expected a list of two points");
  refuses(R"({"type": "capsule", "ends": [[0,1,0],[0,1]], "radius": 1})", "light.ends[1]: expected 3 numbers");
  refuses(R"({"type": "capsule", "ends": [[0,1,0],[0,2,0]], "radius": -1})", "light.radius");
  refuses(R"({"type": "capsule", "ends": [[0,1,0],[0,2,0]], "radius": NaN})", "not JSON");
  refuses(R"({"type": "capsule", "ends": [[0,1,0],[0,2,0]], "radius": 1e999})", "not JSON");
  refuses(R"({"type": "capsule", "ends": [[0,1,0],[0,2,0]], "radius": 1, "two_sided": true})", "light.two_sided: unknown key");
}

}  // namespace steradian::eval::capsule_light_test
