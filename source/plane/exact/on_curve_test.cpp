// Points on outlines of every kind: the light is that of one of their two sides.
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numbers>

#include "night.h"
#include "plane/exact/emission.h"
#include "plane/exact/on_curve.h"
#include "plane/exact/random.h"
#include "plane/exact/world.h"

namespace steradian::plane::on_curve_test {
namespace {

using std::numbers::pi;

PlaneBody random_body(SceneRandom& random, int shape) {
  // Half of the places are centres of pixels, so that sums are exact.
  const bool whole = random.uniform(0, 1) < 0.5;
  const auto number = [&](double low, double high) {
    const double x = random.uniform(low, high);
    return whole ? std::floor(x) + 0.5 : x;
  };
  const auto size = [&](double low, double high) { return whole ? std::ceil(random.uniform(low, high)) : random.uniform(low, high); };
  const Vec2d c{number(20, 80), number(20, 80)};
  const auto v = [&](double r) { return Vec2d{random.uniform(-r, r), random.uniform(-r, r)}; };
  PlaneBody body;
  switch (shape % 6) {
    case 0: return plane_circle(c, size(3, 18));
    case 1:
      body = plane_circle(c, 1);
      body.x_axis = {size(3, 20), 0};
      body.y_axis = {0, size(1, 12)};
      return body;
    case 2:
      body = plane_circle(c, 1);
      body.x_axis = v(20);
      body.y_axis = v(20);
      return body;
    case 3:
      body.shape = PlaneBody::Shape::capsule;
      body.contours = {{c, Vec2d{number(20, 80), number(20, 80)}}};
      body.radius = size(1, 8);
      return body;
    case 4: return plane_polygon({c, c + v(30), c + v(30), c + v(30)});
    default:
      body.shape = PlaneBody::Shape::polyline;
      body.contours = {{c, c + v(30), c + v(30)}};
      return body;
  }
}

// A point on the curve, and a unit vector across it.
struct Place {
  Vec2d at, across;
};
Place place_on(const Curve& c, double share) {
  if (c.kind == Curve::Kind::segment) {
    const Vec2d along = c.b - c.a;
    return {share == 0 ? c.a : c.a + along * share, Vec2d{-along.y, along.x} / length(along)};
  }
  const double tau = c.tau0 + c.tau_span * share;
  const Vec2d along = c.ellipse.y * std::cos(tau) - c.ellipse.x * std::sin(tau);
  return {c.ellipse.at(tau), Vec2d{-along.y, along.x} / length(along)};
}

// Evenly spaced rays, from a place off outlines.
Vec3d mean_of_rays(const World& world, Vec2d p, int count) {
  const World::Inside in = world.inside(p);
  if (in.dark) return {};
  Vec3d sum;
  for (int i = 0; i < count; ++i) {
    const Vec2d u = direction_at(2 * pi * (i + 0.5) / count);
    const RayHit hit = world.grid.first_hit(p, u, in.body);
    if (hit.curve == nullptr) continue;
    const auto& light = world.scene.bodies[static_cast<std::size_t>(hit.curve->body)].light;
    if (!light) continue;
    sum += hit.curve->body == in.body ? radiance_at(*light, p) : radiance_along(*hit.curve, *light, p, u, hit.distance);
  }
  return sum / static_cast<double>(count);
}

}  // namespace

// A jump costs a ray; a place sees some twenty. A nudge of h changes the fraction of directions that a circle of radius r takes by
// sqrt(2 h / r) / pi: 2.6e-5 here.
TEST(PlaneOnCurves, LightIsThatOfOneSide) {
  constexpr int kRays = 20'000;
  constexpr double kNudge = 1e-8, kBound = 20.0 / kRays;
  SceneRandom random(39);
  int tried = 0, beyond = 0;
  for (int s = 0; s < test::by_day_or_night(60, 1500); ++s) {
    PlaneScene scene;
    scene.width = scene.height = 100;
    for (int i = 0; i < 6; ++i) {
      scene.bodies.push_back(random_body(random, s + i));
      if (i == 0 ? s % 4 != 3 : i % 3 == 0) scene.bodies.back().light.emplace().radiance = {1, 0.5, 0.1 * i};
    }
    const PlaneWorld world(scene);
    const World& impl = world.impl();
    for (int k = 0; k < 4; ++k) {
      const Curve& c = impl.curves[static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(impl.first_curve[1]))];
      // Corners, ends of arcs, quarters of arcs, and places between.
      const Place place = place_on(c, k == 0 ? 0 : k == 1 ? 0.25 : random.uniform(0, 1));
      const Vec3d light = world.query(place.at / impl.scale).radiance;
      double off = 1e300;
      std::vector<Vec2d> ways;
      for (Vec2d q : places_beside(impl.around(place.at).on, place.at)) ways.push_back((q - place.at) / length(q - place.at));
      for (int sector = 0; sector < 8; ++sector) ways.push_back(direction_at(angle_of(place.across) + 0.25 * pi * sector));
      for (Vec2d u : ways) {
        const Vec3d side = mean_of_rays(impl, place.at + u * kNudge * impl.scale, kRays);
        off = std::min(off, std::max({std::fabs(light.x - side.x), std::fabs(light.y - side.y), std::fabs(light.z - side.z)}));
        if (off <= kBound) break;
      }
      ++tried;
      if (off <= kBound) continue;
      if (++beyond <= 3) ADD_FAILURE() << "scene " << s << ", place " << k << ": " << light.x << ", off by " << off;
    }
  }
  EXPECT_EQ(beyond, 0) << "of " << tried;
  std::printf("points on outlines: %d of %d are beyond %.0e\n", beyond, tried, kBound);
}

// All of a light's outline is within the light, whatever is outside of it.
TEST(PlaneOnCurves, AllOfALightsOutlineIsWithinIt) {
  SceneRandom random(40);
  int off = 0, tried = 0;
  for (int s = 0; s < 300; ++s) {
    PlaneScene scene;
    scene.width = scene.height = 100;
    scene.bodies = {random_body(random, s % 5), plane_polygon({{0, 0}, {100, 0}, {100, 1}, {0, 1}}), plane_circle({50, 97}, 2)};
    if (bounds_of(scene.bodies[0]).low.y < 2 || bounds_of(scene.bodies[0]).high.y > 94) continue;
    scene.bodies[0].light.emplace();
    scene.bodies[2].light.emplace().radiance = {7, 7, 7};
    const PlaneWorld world(scene);
    const World& impl = world.impl();
    for (std::size_t c = 0; c < impl.first_curve[1]; ++c)
      for (double share : {0.0, 0.125, 0.25, 0.5, random.uniform(0, 1), random.uniform(0, 1)}) {
        ++tried;
        const double light = world.query(place_on(impl.curves[c], share).at / impl.scale).radiance.x;
        if (!(std::fabs(light - 1) <= 1e-12) && ++off <= 3)
          ADD_FAILURE() << "scene " << s << ", curve " << c << ", " << share << ": " << light;
      }
  }
  EXPECT_EQ(off, 0) << "of " << tried;
  std::printf("on lights' outlines: %d of %d are not within\n", off, tried);
}

// Looking at a place in which two outlines touch does not make the farther one visible.
TEST(PlaneOnCurves, OutlinesThatTouchInTheMiddleOfTheViewKeepTheirOrder) {
  PlaneScene scene;
  scene.width = scene.height = 100;
  scene.bodies = {plane_circle({50, 50}, 10), plane_circle({43, 50}, 3)};
  scene.bodies[0].light.emplace().radiance = {1, 0, 0};
  scene.bodies[1].light.emplace().radiance = {0, 1, 0};
  const Vec3d light = PlaneWorld(scene).query({20, 50}).radiance;
  EXPECT_NEAR(light.x, std::asin(10.0 / 30) / pi, 1e-12);
  EXPECT_NEAR(light.y, 0, 1e-12);
}

TEST(PlaneOnCurves, DistanceIsThatOfTheCurve) {
  const Curve arc = outline_of(plane_circle({10, 20}, 5), 0).front();
  EXPECT_NEAR(distance_to(arc, {13 + 3e-6, 24 + 4e-6}), 5e-6, 1e-14);
  EXPECT_TRUE(is_on(arc, {13, 24}));
  EXPECT_FALSE(is_on(arc, {13, 24 + 1e-12}));
  PlaneBody ellipse = plane_circle({0, 0}, 1);
  ellipse.x_axis = {30, 0};
  ellipse.y_axis = {0, 2};
  const Curve wide = outline_of(ellipse, 0).front();
  EXPECT_NEAR(distance_to(wide, {0, 2 + 1e-6}), 1e-6, 1e-12);
  EXPECT_NEAR(distance_to(wide, {30 - 1e-6, 0}), 1e-6, 1e-10);
  // Half of a circle ends in its middle.
  Curve half = arc;
  half.tau_span = pi;
  half.b = half.ellipse.at(pi);
  EXPECT_NEAR(distance_to(half, {15, 19}), 1, 1e-14);
  EXPECT_FALSE(is_on(half, {10, 15}));
}

}  // namespace steradian::plane::on_curve_test
