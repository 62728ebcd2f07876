#include "reference/past_occluders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/random.h"
#include "night.h"
#include "reference/sampled.h"
#include "shadow/rays/triangle_rays.h"

namespace steradian::reference::past_occluders_test {
namespace {

AreaLight light_of_kind(int kind) {
  AreaLight light;
  light.two_sided = true;
  switch (kind) {
    case 0:
      light.shape = Polygon{{{-.5, 2, .5}, {-.5, 2, -.5}, {.6, 2, -.5}, {.5, 2, .6}}, {{{-.2, 2, .2}, {-.2, 2, -.2}, {.2, 2, -.2}}}};
      break;
    case 1: light.shape = Ellipse{{.2, 2, .1}, {.5, 0, .1}, {0, 0, .4}}; break;
    case 2: light.shape = Ellipsoid{{.2, 2, .1}, {.5, 0, .1}, {0, .3, .1}, {0, 0, .4}}; break;
    case 3: light.shape = Capsule{{-.7, 1.6, .1}, {.5, 1.7, 0}, .2}; break;
    default: light.shape = Capsule{{0, 2.4, 0}, {.05, 1.4, 0}, .05};  // seen along its axis
  }
  return light;
}
constexpr int kKinds = 5;

struct Configuration {
  AreaLight light;
  std::vector<Blocker> blockers;
  ShadingPoint at;
  Material material;
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;
};

Configuration random_configuration(Random& random, int number) {
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  Configuration c{light_of_kind(number % kKinds), {}, {}, {}, {}, {}};
  for (int i = number % 6; i > 0; --i) {
    const Vec3d middle{between(-.6, .6), between(.5, 2), between(-.6, .6)};
    Blocker& b = c.blockers.emplace_back();
    for (Vec3d& v : b) {
      v = middle + Vec3d{between(-.5, .5), between(-.3, .3), between(-.5, .5)};
      c.indices.push_back(static_cast<std::uint32_t>(c.positions.size()));
      c.positions.push_back(v);
    }
  }
  c.at.position = {between(-1, 1), between(0, .3), between(-1, 1)};
  c.at.normal = normalized(Vec3d{between(-.3, .3), 1, between(-.3, .3)});
  c.at.view = normalized(Vec3d{between(-1, 1), 1, between(-1, 1)});
  if (number % 3 == 1) c.material.brdf = Brdf::ggx, c.material.alpha_x = c.material.alpha_y = between(.1, .5);
  if (number % 3 == 2) c.material.brdf = Brdf::phong, c.material.exponent = between(1, 20);
  return c;
}

ReferenceResult past(const Configuration& c) {
  return radiance_past(c.blockers, c.light, c.at, c.at.normal, c.material, {1e-9, 1e-13, 20'000'000});
}

SampledResult by_rays(const Configuration& c, int spp) {
  const shadow::TriangleRays rays(shadow::build_edges(c.positions, c.indices));
  const auto open = [&](Vec3d to) { return !rays.between(c.at.position, c.at.position + to * (1 - 1e-9)); };
  const SampledOptions options{spp, 1};
  if (!std::holds_alternative<Polygon>(c.light.shape)) return sampled_on_surface(open, c.light, c.at, c.material, options);
  const PreparedPolygon polygon = prepare_polygon(flat_polygon(c.light));
  const double height = dot(polygon.centroid - c.at.position, polygon.normal);
  return sampled_radiance_past([&](Vec3d d) { return open(d * (height / dot(d, polygon.normal))); }, polygon, c.at, c.material, options);
}

TEST(PastOccluders, AgreesWithRays) {
  const int count = test::by_day_or_night(60, 600);
  Random random(3);
  int beyond = 0;
  double worst = 0, worst_bound = 0;
  for (int i = 0; i < count; ++i) {
    const Configuration c = random_configuration(random, i);
    const ReferenceResult r = past(c);
    const SampledResult rays = by_rays(c, 20'000);
    const double off = std::fabs(r.radiance.x - rays.radiance.x);
    worst = std::max(worst, off / std::max(rays.standard_error, 1e-300));
    worst_bound = std::max(worst_bound, r.bound / std::max(r.radiance.x, 1e-6));
    // 5 standard errors. Below a thousandth of a typical answer rays are too few for a standard error.
    if (off > 5 * rays.standard_error + 1e-6) {
      ++beyond;
      ADD_FAILURE() << i << ": " << r.radiance.x << " +- " << r.bound << ", rays " << rays.radiance.x << " +- " << rays.standard_error;
    }
  }
  std::printf("%d tried, %d beyond 5 standard errors, worst %.1f; largest bound %.1e of the answer\n", count, beyond, worst, worst_bound);
  EXPECT_LT(worst_bound, 1e-6);
}

// Without occluders, the cubature over a fan judges it: another parametrization, and for the ellipse a polygon of 2048 corners of equal
// area. That polygon's error falls with the fourth power of the step: (2 pi / 2048)^4 / 120 = 7e-13 of the light, times the concentration
// of the lobe.
TEST(PastOccluders, AgreesWithTheFanWithoutOccluders) {
  Random random(4);
  for (int i = 0; i < 24; ++i) {
    Configuration c = random_configuration(random, i % kKinds < 2 ? i : i + 2);
    if (!c.light.is_flat()) continue;
    c.blockers.clear();
    const ReferenceResult r = past(c), fan = reference_radiance(prepare_polygon(flat_polygon(c.light, 2048)), c.at, c.material);
    EXPECT_NEAR(r.radiance.x, fan.radiance.x, r.bound + fan.bound + 1e-10 * fan.radiance.x) << i;
    EXPECT_GT(fan.radiance.x, 0) << i;
  }
}

// A ball on the axis of the normal has the form factor sin(half angle)^2. A half plane of triangles through its middle hides half of it.
TEST(PastOccluders, HasTheFormFactorOfABallAndItsHalf) {
  AreaLight ball;
  ball.shape = Ellipsoid{{0, 2, 0}, {.5, 0, 0}, {0, .5, 0}, {0, 0, .5}};
  const ShadingPoint at{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}};
  Material m;
  m.albedo = {1, 1, 1};
  const ReferenceOptions options{1e-12, 0, 20'000'000};
  EXPECT_NEAR(radiance_past({}, ball, at, at.normal, m, options).radiance.x, 1. / 16, 1e-13);
  const Blocker half[] = {{Vec3d{0, 1, -9}, Vec3d{0, 1, 9}, Vec3d{9, 1, 0}}};
  EXPECT_NEAR(radiance_past(half, ball, at, at.normal, m, options).radiance.x, 1. / 32, 1e-13);
}

// A plate through the ball's middle blocks what is beyond it, and nothing of the half before it: the ball is convex.
TEST(PastOccluders, WhatIsInsideABodyDoesNotBlockIt) {
  AreaLight ball;
  ball.shape = Ellipsoid{{0, 2, 0}, {.5, 0, 0}, {0, .5, 0}, {0, 0, .5}};
  const ShadingPoint at{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}};
  const ReferenceOptions options{1e-12, 0, 20'000'000};
  const double whole = radiance_past({}, ball, at, at.normal, {}, options).radiance.x;
  const auto behind = [&](double height) {
    const Blocker plate[] = {{Vec3d{-9, height, -9}, Vec3d{9, height, -9}, Vec3d{0, height, 9}}};
    return radiance_past(plate, ball, at, at.normal, {}, options).radiance.x;
  };
  EXPECT_NEAR(behind(2), whole, 1e-13);     // the outline touches the ball below its middle
  EXPECT_NEAR(behind(1.875), whole, 1e-9);  // at the outline's circle
  EXPECT_EQ(behind(1.4), 0);
  // The plate at 1.6 leaves the circle in which it cuts the ball: of radius 0.3 at that distance, within the cone.
  EXPECT_NEAR(behind(1.6), whole * (.09 / (.09 + 1.6 * 1.6)) * 16, 1e-12);
}

// The point lies inside a triangle: the side from which the horizon points away is dark, however the triangle leans.
TEST(PastOccluders, APointOnATriangleSeesItsSideOnly) {
  AreaLight light;
  light.shape = Polygon{{{-1, 2, 1}, {-1, 2, -1}, {1, 2, -1}, {1, 2, 1}}, {}};
  const ShadingPoint at{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}};
  const ReferenceOptions options{1e-10, 0, 20'000'000};
  const double whole = radiance_past({}, light, at, at.normal, {}, options).radiance.x;
  const Blocker upright[] = {{Vec3d{0, -9, -9}, Vec3d{0, -9, 9}, Vec3d{0, 9, 0}}};
  const ReferenceResult tilted = radiance_past(upright, light, at, normalized(Vec3d{1, 1, 0}), {}, options);
  EXPECT_NEAR(tilted.radiance.x, whole / 2, 1e-9 * whole);
  const Blocker floor[] = {{Vec3d{-9, 0, -9}, Vec3d{9, 0, -9}, Vec3d{0, 0, 9}}};
  EXPECT_EQ(radiance_past(floor, light, at, at.normal, {}, options).radiance.x, whole);
}

}  // namespace
}  // namespace steradian::reference::past_occluders_test
