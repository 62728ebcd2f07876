// Interreflection against exact results, against traced paths, and against a refined solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/exact/random.h"
#include "plane/exact/world.h"
#include "steradian/plane_bounce.h"

namespace steradian::plane::bounces_test {
namespace {

using std::numbers::pi;

PlaneBody wall(Vec2d a, Vec2d b, double albedo, double emission) {
  PlaneBody body;
  body.shape = PlaneBody::Shape::polyline;
  body.contours = {{a, b}};
  body.albedo = Vec3d{albedo, albedo, albedo};
  if (emission > 0) body.light.emplace().radiance = {emission, emission, emission};
  return body;
}

PlaneScene square_room(double albedo, double first, double others) {
  PlaneScene scene;
  scene.width = scene.height = 1;
  const Vec2d p[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int k = 0; k < 4; ++k) scene.bodies.push_back(wall(p[k], p[(k + 1) % 4], albedo, k == 0 ? first : others));
  return scene;
}

double total(const PlaneWorld& world, const PlaneBounces& bounces, Vec2d p) {
  return world.query(p).radiance.x + bounces.query(p).radiance.x;
}

// A furnished room, lit by a lamp with a range and a lamp in the corner.
PlaneScene furnished_room(int boxes, std::uint64_t seed) {
  SceneRandom random(seed);
  PlaneScene scene;
  scene.width = scene.height = 100;
  const Vec2d p[] = {{2, 2}, {98, 2}, {98, 98}, {2, 98}};
  for (int k = 0; k < 4; ++k) scene.bodies.push_back(wall(p[k], p[(k + 1) % 4], 0.75, 0));
  for (int i = 0; i < boxes;) {
    const Vec2d c{random.uniform(15, 85), random.uniform(15, 85)};
    // Boxes keep clear of the lamps: paths do not handle walls within a light.
    if (length(c - Vec2d{22, 24}) < 16 || length(c - Vec2d{75, 70}) < 16) continue;
    const double t = random.uniform(0, pi), h = random.uniform(3, 8);
    const Vec2d x{h * std::cos(t), h * std::sin(t)}, y = Vec2d{-x.y, x.x} * random.uniform(0.2, 1);
    scene.bodies.push_back(i % 4 == 3 ? plane_circle(c, h) : plane_polygon({c - x - y, c + x - y, c + x + y, c - x + y}));
    scene.bodies.back().albedo = Vec3d{0.75, 0.5, 0.25};
    ++i;
  }
  scene.bodies.push_back(plane_circle({22, 24}, 3));
  scene.bodies.back().light.emplace().radiance = {4, 4, 4};
  scene.bodies.push_back(plane_circle({75, 70}, 2));
  scene.bodies.back().light.emplace().radiance = {3, 3, 6};
  scene.bodies.back().light->range = 60;
  return scene;
}

}  // namespace

// If all walls emit 1 and reflect rho of the arriving light, every point and wall has 1 / (1 - rho). This holds in a bare room, and among
// boxes, rounds and lines that cut and occlude each other at any angle. The rest is rounding: a row has some hundred terms of 1e-16, and
// sweeps end at 1e-14, times 1 / (1 - rho)^2.
TEST(PlaneBounces, FillAFurnaceEvenly) {
  for (int furniture : {0, 12, 30})
    for (double albedo : {0.3, 0.7}) {
      PlaneScene scene = square_room(albedo, 1, 1);
      SceneRandom random(static_cast<std::uint64_t>(furniture));
      for (int i = 0; i < furniture; ++i) {
        const Vec2d c{random.uniform(0.1, 0.9), random.uniform(0.1, 0.9)};
        const double t = random.uniform(0, pi), h = random.uniform(0.02, 0.1);
        const Vec2d x{h * std::cos(t), h * std::sin(t)}, y = Vec2d{-x.y, x.x} * random.uniform(0.2, 1);
        PlaneBody body = i % 4 == 3   ? plane_circle(c, h)
                         : i % 4 == 2 ? wall(c - x, c + y, albedo, 1)
                                      : plane_polygon({c - x - y, c + x - y, c + x + y, c - x + y});
        body.albedo = Vec3d{albedo, albedo, albedo};
        body.light.emplace();
        scene.bodies.push_back(body);
      }
      const PlaneWorld world(scene);
      const PlaneBounces bounces(world);
      const double expected = 1 / (1 - albedo);
      double worst = 0;
      for (int i = 0; i < 50;) {
        const Vec2d p{random.uniform(0.01, 0.99), random.uniform(0.01, 0.99)};
        if (world.impl().inside(p * world.impl().scale).body >= 0) continue;
        worst = std::max(worst, std::fabs(total(world, bounces, p) - expected));
        ++i;
      }
      std::printf("furnace of albedo %g with %d things in it: within %.1e, %zu elements, %d sweeps\n", albedo, furniture, worst,
                  bounces.stats().elements, bounces.stats().sweeps);
      EXPECT_LT(worst, 1e-12);
    }
}

// Values by an independent program: elements of degree 3, refined to 1e-7.
TEST(PlaneBounces, KnowTheSquareRoom) {
  const PlaneScene scene = square_room(0.5, 1, 0);
  const PlaneWorld world(scene);
  const PlaneBounces bounces(world);
  EXPECT_NEAR(total(world, bounces, {0.5, 0.5}), 0.5, 2e-4);
  EXPECT_NEAR(total(world, bounces, {0.5, 0.9}), 0.4278741, 2e-4);
  EXPECT_NEAR(total(world, bounces, {0.1, 0.1}), 0.6113359, 2e-4);
  std::printf("%zu elements, error %.1e, %d rounds, %d sweeps\n", bounces.stats().elements, bounces.stats().error, bounces.stats().rounds,
              bounces.stats().sweeps);
}

// One bounce after another, and all of them: each adds less than the one before it times the albedo.
TEST(PlaneBounces, CountTheBounces) {
  const PlaneScene scene = furnished_room(4, 1);
  const PlaneWorld world(scene);
  PlaneBounceOptions options;
  const Vec2d p{50, 8};
  double last = 0, added = 1e9;
  for (options.bounces = 1; options.bounces <= 4; ++options.bounces) {
    const double light = PlaneBounces(world, options).query(p).radiance.x;
    EXPECT_GT(light, last);
    EXPECT_LT(light - last, added);
    added = light - last;
    last = light;
  }
  options.bounces = 0;
  EXPECT_EQ(PlaneBounces(world, options).query(p).radiance.x, 0);
  options.bounces = kAllBounces;
  EXPECT_GT(PlaneBounces(world, options).query(p).radiance.x, last);
}

// A lamp half in a box: the box' edges within the lamp are not visible, and light from within does not reach those outside.
TEST(PlaneBounces, StopAtOutlinesThatCrossAWall) {
  PlaneScene scene;
  scene.width = scene.height = 100;
  scene.bodies.push_back(plane_polygon({{20, 40}, {60, 40}, {60, 60}, {20, 60}}));
  scene.bodies.back().albedo = Vec3d{1, 1, 1};
  scene.bodies.push_back(plane_circle({40, 40}, 5));
  scene.bodies.back().light.emplace();
  const PlaneWorld world(scene);
  const PlaneBounces bounces(world);
  // At a distance x from its centre the top receives the integral of the sine up to the lamp's tangent: 1 - sqrt(1 - (5/x)^2). The part of
  // the top that the lamp occludes, from 20 above it, ends at 20 tan(asin(1/4)).
  double expected = 0;
  const double first = 20 / std::sqrt(15.0), step = (20 - first) / 10000;
  for (int i = 0; i < 10000; ++i) {
    const double x = first + step * (i + 0.5), sent = 0.98 * 0.5 * (1 - std::sqrt(1 - 25 / (x * x)));
    expected += 2 * sent * step * 20 / (400 + x * x) / (2 * pi);
  }
  const double above = bounces.query({40, 20}).radiance.x, beside = bounces.query({30, 39}).radiance.x;
  std::printf("above the lamp %.6f, expected %.6f\n", above, expected);
  EXPECT_NEAR(above, expected, 1e-3 * expected + bounces.error({40, 20}).x);
  // This follows by symmetry.
  EXPECT_NEAR(beside, bounces.query({50, 39}).radiance.x, 1e-6 * beside);
}

// The error estimate has the right size: the default against a solution five times as fine.
TEST(PlaneBounces, SayHowFarTheyAreOff) {
  for (std::uint64_t seed : {1u, 2u}) {
    const PlaneScene scene = furnished_room(8, seed);
    const PlaneWorld world(scene);
    PlaneBounceOptions fine;
    fine.tolerance = 2e-4;
    const PlaneBounces coarse(world), reference(world, fine);
    SceneRandom random(seed);
    double squares = 0, estimated = 0, mean = 0, worst = 0;
    int count = 0;
    while (count < 60) {
      const Vec2d p{random.uniform(3, 97), random.uniform(3, 97)};
      if (world.impl().inside(p * world.impl().scale).dark || world.impl().inside(p * world.impl().scale).body >= 0) continue;
      const double exact = reference.query(p).radiance.x, error = coarse.query(p).radiance.x - exact;
      squares += error * error;
      estimated += coarse.error(p).x;
      worst = std::max(worst, std::fabs(error));
      mean += exact;
      ++count;
    }
    const double rms = std::sqrt(squares / count) / (mean / count);
    std::printf(
        "seed %d: %zu elements in %.1f ms, %zu in %.1f ms; rms %.1e, largest %.1e of the mean; estimated %.1e at points, %.1e on walls\n",
        static_cast<int>(seed), coarse.stats().elements, coarse.stats().ms, reference.stats().elements, reference.stats().ms, rms,
        worst / (mean / count), estimated / mean, coarse.stats().error);
    EXPECT_LT(rms, 2e-3);
    EXPECT_LT(rms, estimated / mean);
    EXPECT_GT(rms, 0.01 * estimated / mean);
  }
}

namespace {

// Radiance along random paths; every ray is tested against every curve.
class PathTracer {
 public:
  PathTracer(const World& world, std::uint64_t seed) : world_(world), random_(seed) {}
  double radiance(Vec2d from, Vec2d u, const Curve* leave) {
    double weight = 1, sum = 0;
    for (int bounce = 0; bounce < 200; ++bounce) {
      const Curve* hit = nullptr;
      double nearest = 1e300;
      for (const Curve& c : world_.curves) {
        if (&c == leave) continue;
        const double r = hits(c, from, u);
        if (r > 0 && r < nearest) nearest = r, hit = &c;
      }
      if (hit == nullptr) return sum;
      const PlaneBody& body = world_.scene.bodies[static_cast<std::size_t>(hit->body)];
      if (body.light) {
        if (bounce == 0) return 0;  // direct light: not a bounce
        const double q = nearest / body.light->range, window = std::isinf(body.light->range) ? 1 : q < 1 ? (1 - q * q) * (1 - q * q) : 0;
        return sum + weight * body.light->radiance.x * window;
      }
      weight *= body.albedo->x;
      if (weight < 0.2) {
        if (random_.uniform() > weight / 0.4) return sum;
        weight = 0.4;
      }
      from = from + u * nearest;
      Vec2d n;
      if (hit->kind == Curve::Kind::segment) {
        const Vec2d e = hit->b - hit->a;
        n = Vec2d{e.y, -e.x} / length(e);
      } else {
        n = from - hit->ellipse.center;
        n = n / length(n);
      }
      if (dot(n, u) > 0) n = -n;
      const double sine = random_.uniform(-1, 1), cosine = std::sqrt(1 - sine * sine);
      u = n * cosine + Vec2d{-n.y, n.x} * sine;
      leave = hit;
    }
    return sum;
  }

 private:
  static double hits(const Curve& c, Vec2d from, Vec2d u) {
    if (c.kind == Curve::Kind::segment) {
      const Vec2d e = c.b - c.a;
      const double det = cross(u, e), r = cross(c.a - from, e) / det, s = cross(c.a - from, u) / det;
      return det != 0 && s >= 0 && s <= 1 && r > 0 ? r : -1;
    }
    const Vec2d to = c.ellipse.center - from;
    const double b = dot(to, u), root2 = b * b - dot(to, to) + dot(c.ellipse.x, c.ellipse.x);
    return root2 > 0 && b > 0 ? b - std::sqrt(root2) : -1;
  }
  const World& world_;
  SceneRandom random_;
};

}  // namespace

// The difference is within four standard errors of the paths' mean, plus the estimated error of the elements.
TEST(PlaneBounces, AgreeWithTracedPaths) {
  const PlaneScene scene = furnished_room(6, 4);
  const PlaneWorld world(scene);
  PlaneBounceOptions options;
  options.tolerance = 3e-4;
  const PlaneBounces bounces(world, options);
  PathTracer tracer(world.impl(), 9);
  SceneRandom random(8);
  const double scale = world.impl().scale;
  for (const Vec2d p : {Vec2d{50, 8}, Vec2d{8, 50}, Vec2d{92, 91}, Vec2d{30, 12}}) {
    const int paths = 20000;
    double sum = 0, squares = 0;
    for (int i = 0; i < paths; ++i) {
      const double t = 2 * pi * (i + random.uniform()) / paths, x = tracer.radiance(p * scale, {std::cos(t), std::sin(t)}, nullptr);
      sum += x;
      squares += x * x;
    }
    const double mean = sum / paths, standard = std::sqrt((squares / paths - mean * mean) / paths), light = bounces.query(p).radiance.x;
    std::printf("(%g, %g): %.5f, by paths %.5f +- %.5f\n", p.x, p.y, light, mean, standard);
    EXPECT_NEAR(light, mean, 4 * standard + bounces.error(p).x);
  }
}

// Pictures draw the elements as lights, on packs: every pixel equals a query at its centre. The scene has overlapping boxes, outlines with
// many edges and round walls.
TEST(PlaneBounces, FramesEqualTheQuery) {
  PlaneScene scene = furnished_room(9, 6);
  PlaneBody heart;
  heart.contours.emplace_back();
  for (int i = 0; i < 40; ++i) {
    const double t = 2 * pi * i / 40;
    heart.contours[0].push_back({50 + 9 * std::cos(t), 50 + 6 * std::sin(t) + 3 * std::fabs(std::cos(t))});
  }
  heart.color = {0.6, 0.6, 0.1};
  scene.bodies.push_back(heart);
  PlaneBody capsule;
  capsule.shape = PlaneBody::Shape::capsule;
  capsule.contours = {{{80, 20}, {92, 30}}};
  capsule.radius = 4;
  capsule.color = {0.9, 0.2, 0.9};
  scene.bodies.push_back(capsule);
  const PlaneWorld world(scene);
  PlaneBounceOptions rough;
  rough.tolerance = 1e-2;
  const PlaneBounces bounces(world, rough);
  PlaneFrameOptions options;
  options.width = options.height = 96;
  options.bounces = &bounces;
  options.bounce_error = true;
  const Picture picture = render_plane(world, options);
  double worst = 0, worst_error = 0, brightest = 0;
  for (int i = 0; i < 96 * 96; i += 7) {
    const Vec2d p{(i % 96 + 0.5) * 100 / 96, (i / 96 + 0.5) * 100 / 96};
    const Vec3d expected = world.query(p).radiance + bounces.query(p).radiance, error = bounces.error(p);
    const Vec3f pixel = picture.pixels[static_cast<std::size_t>(i)], layer = picture.layers.at("bounce_error")[static_cast<std::size_t>(i)];
    worst = std::max({worst, std::fabs(expected.x - static_cast<double>(pixel.x)), std::fabs(expected.z - static_cast<double>(pixel.z))});
    worst_error = std::max(worst_error, std::fabs(error.x - static_cast<double>(layer.x)));
    brightest = std::max(brightest, expected.x);
  }
  std::printf("largest difference %.1e, of the error %.1e; brightest %.2f\n", worst, worst_error, brightest);
  // 1e-5 of the brightest light, and as much again for the walls, which are many separate lights.
  EXPECT_LT(worst, 2e-5 * 6);
  EXPECT_LT(worst_error, 2e-5);
  // Deterministic, with any number of threads.
  options.threads = 1;
  EXPECT_TRUE(std::equal(picture.pixels.begin(), picture.pixels.end(), render_plane(world, options).pixels.begin(),
                         [](const Vec3f& a, const Vec3f& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }));
}

}  // namespace steradian::plane::bounces_test
