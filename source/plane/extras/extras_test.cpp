// Extras against rays that use no envelope, against closed forms if they exist, and frames against the query.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

#include "night.h"
#include "plane/exact/random.h"
#include "plane/extras/trace.h"
#include "steradian/error.h"
#include "steradian/plane_bounce.h"
#include "steradian/plane_normals.h"
#include "steradian/plane_stage.h"
#include "support/plane_families.h"

namespace steradian::plane::extras_test {
namespace {

using std::numbers::pi;

PlaneBody box(double x, double y, double w, double h) { return plane_polygon({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}); }

PlaneBody line(Vec2d a, Vec2d b) {
  PlaneBody body;
  body.shape = PlaneBody::Shape::polyline;
  body.contours = {{a, b}};
  return body;
}

PlaneBody lit(PlaneBody body, Vec3d radiance = {1, 1, 1}) {
  body.light.emplace().radiance = radiance;
  return body;
}

PlaneBody clear(PlaneBody body, Vec3d transmittance) {
  body.transmittance = transmittance;
  return body;
}

PlaneBody mirror(PlaneBody body, Vec3d share = {1, 1, 1}) {
  body.mirror = share;
  return body;
}

PlaneBody deep(PlaneBody body, double depth) {
  body.light_depth = depth;
  return body;
}

PlaneScene scene_of(std::vector<PlaneBody> bodies) {
  PlaneScene scene;
  scene.width = scene.height = 100;
  scene.bodies = std::move(bodies);
  return scene;
}

// Three lights, one of each kind of outline, and boxes and circles that may overlap them and each other. matter: 1 adds clear bodies, 2
// mirrors, 4 absorbing bodies, 8 fog, 16 suns.
PlaneScene random_scene(int matter, std::uint64_t seed) {
  SceneRandom random(seed);
  PlaneScene scene = scene_of({});
  const auto at = [&] { return Vec2d{random.uniform(5, 95), random.uniform(5, 95)}; };
  for (int i = 0; i < 3; ++i) {
    const Vec2d c = at();
    const double h = random.uniform(3, 7);
    PlaneBody light = i == 0 ? plane_circle(c, h) : i == 1 ? box(c.x - h, c.y - 0.5 * h, 2 * h, h) : line(c, c + Vec2d{h, 2 * h});
    light.light.emplace().radiance = {random.uniform(0.5, 2), random.uniform(0.5, 2), random.uniform(0.5, 2)};
    if (i == 0) light.light->range = 80;
    if (i == 1) light.light->profile = PlaneProfile::lambert;
    scene.bodies.push_back(light);
  }
  for (int i = 0; i < 9; ++i) {
    const Vec2d c = at();
    const double t = random.uniform(0, pi), h = random.uniform(3, 8);
    const Vec2d x{h * std::cos(t), h * std::sin(t)}, y = Vec2d{-x.y, x.x} * random.uniform(0.2, 1);
    PlaneBody body = i % 3 == 2 ? plane_circle(c, h) : plane_polygon({c - x - y, c + x - y, c + x + y, c - x + y});
    if ((matter & 1) != 0 && i < 5) body.transmittance = Vec3d{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
    if ((matter & 2) != 0 && (i == 6 || i == 7)) body.mirror = Vec3d{1, 0.5, random.uniform(0, 1)};
    if ((matter & 4) != 0 && (i == 5 || i == 8)) body.light_depth = random.uniform(2, 8);
    scene.bodies.push_back(body);
  }
  if ((matter & 2) != 0) scene.bodies.push_back(mirror(line(at(), at()), {0.9, 0.9, 0.9}));
  if ((matter & 8) != 0) scene.fog_density = 0.02;
  if ((matter & 16) != 0) {
    scene.suns.push_back({{1, 0.8, 0.5}, random.uniform(-pi, pi), 0.05});
    scene.suns.push_back({{0.2, 0.3, 0.5}, 3.1, 0.4});
    scene.suns.push_back({{0.1, 0.2, 0.1}, random.uniform(-pi, pi), 0});
  }
  return scene;
}

// Evenly spaced rays; suns without width are added separately.
PlaneLight traced(const PlaneWorld& world, Vec2d p, int rays) {
  const World& impl = world.impl();
  std::vector<const Curve*> curves;
  for (const Curve& c : impl.curves) curves.push_back(&c);
  const Tracer tracer(impl, curves, p * impl.scale);
  PlaneLight sum = tracer.hard_suns();
  for (int i = 0; i < rays; ++i) {
    const double angle = 2 * pi * (i + 0.5) / rays;
    const Vec2d u{std::cos(angle), std::sin(angle)};
    const Vec3d radiance = tracer.radiance(u) * (2 * pi / rays);
    sum.radiance += radiance;
    sum.moment_x += radiance * u.x;
    sum.moment_y += radiance * u.y;
  }
  const double scale = 1 / (2 * pi);
  return {sum.radiance * scale, sum.moment_x * scale, sum.moment_y * scale};
}

double difference(Vec3d a, Vec3d b) { return std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)}); }

struct Worst {
  double radiance = 0, moment = 0, squares = 0;
  int points = 0;
  void add(const PlaneLight& a, const PlaneLight& b) {
    const double off = difference(a.radiance, b.radiance);
    radiance = std::max(radiance, off);
    moment = std::max({moment, difference(a.moment_x, b.moment_x), difference(a.moment_y, b.moment_y)});
    squares += off * off;
    ++points;
  }
};

// Every jump of radiance is off by at most the weight of one ray, and by half a ray on average. There are at most 2 (lights) and 2 x (3
// lights, 12 bodies, two outlines' ends and a crossing each) jumps for a point and the few mirrors that it sees. Ten jumps of one sign are
// more than occur.
Worst expect_rays(int matter, int scenes, int rays) {
  Worst worst;
  for (int s = 0; s < scenes; ++s) {
    const PlaneWorld world(random_scene(matter, static_cast<std::uint64_t>(100 * matter + s)));
    SceneRandom random(static_cast<std::uint64_t>(s + 7));
    for (int k = 0; k < 12; ++k) {
      const Vec2d p{random.uniform(0, 100), random.uniform(0, 100)};
      const PlaneLight exact = world.query(p), rough = traced(world, p, rays);
      worst.add(exact, rough);
      EXPECT_LE(difference(exact.radiance, rough.radiance), 20.0 / rays)
          << "matter " << matter << ", scene " << s << " at (" << p.x << ", " << p.y << ")";
    }
  }
  EXPECT_LE(worst.moment, 20.0 / rays);
  std::printf("matter %2d: rms %.1e, largest %.1e, of moments %.1e, of %d points\n", matter, std::sqrt(worst.squares / worst.points),
              worst.radiance, worst.moment, worst.points);
  return worst;
}

}  // namespace

TEST(PlaneExtras, AgreeWithRaysOneByOneAndTogether) {
  for (int matter : {1, 2, 4, 8, 16, 21, 31}) expect_rays(matter, 6, 10'000);
}

// The part of the sun above a hard edge: E / 2 pi, all or nothing, for a sun without width; the part above the edge for a sun with a width.
TEST(PlaneExtras, SunsShineOverAnEdge) {
  PlaneScene scene = scene_of({box(40, 50, 20, 50)});
  scene.suns = {{{2, 1, 0.5}, -pi / 4, 0.1}};
  const PlaneWorld soft(scene);
  EXPECT_NEAR(soft.query({30, 20}).radiance.x, 2 * 0.2 / (2 * pi), 1e-15);
  // The corner (40, 50) is at atan2(-h, 20) = -pi/4 - 0.04: the part above it (towards -pi/2) is visible.
  const double h = 20 * std::tan(pi / 4 + 0.04);
  EXPECT_NEAR(soft.query({20, 50 + h}).radiance.y, (0.1 - 0.04) / (2 * pi), 1e-14);
  EXPECT_NEAR(soft.query({20, 50 + h}).moment_x.y, (std::sin(-pi / 4 - 0.04) - std::sin(-pi / 4 - 0.1)) / (2 * pi), 1e-14);
  EXPECT_EQ(soft.query({50, 70}).radiance.x, 0);
  scene.suns[0].half_width = 0;
  const PlaneWorld hard(scene);
  EXPECT_NEAR(hard.query({30, 40}).radiance.x, 2 / (2 * pi), 1e-15);
  EXPECT_NEAR(hard.query({20, 69.9}).radiance.x, 2 / (2 * pi), 1e-15);
  EXPECT_EQ(hard.query({20, 70.1}).radiance.x, 0);
  // A narrow sun of the same strength gives nearly the same light.
  scene.suns[0] = {{1e4, 1e4, 1e4}, -pi / 4, 1e-4};
  EXPECT_NEAR(PlaneWorld(scene).query({20, 69.9}).radiance.x, 2 / (2 * pi), 1e-12);
}

// The formula of plane2.md, term by term and without sorting, for circles in front of a circular light. It is the sum over all ends s of
// (1 - tau_i) times the others' transmittance there times the light's angle up to s, + at a begin, - at an end.
TEST(PlaneExtras, ClearBodiesAreASumOverTheirEnds) {
  SceneRandom random(5);
  int checked = 0;
  for (int repeat = 0; repeat < 50; ++repeat) {
    PlaneScene scene = scene_of({lit(plane_circle({80, 50}, 10))});
    struct Shadow {
      double begin, end, tau;
    };
    std::vector<Shadow> shadows;
    const double half = std::asin(10.0 / 70);  // half angle of the light from (10, 50)
    for (int i = 0; i < 5; ++i) {
      const Vec2d c{random.uniform(25, 60), random.uniform(46, 54)};
      const double r = random.uniform(0.5, 3), tau = random.uniform(0, 1);
      scene.bodies.push_back(clear(plane_circle(c, r), {tau, 0, 1}));
      const Vec2d to = c - Vec2d{10, 50};
      const double a = std::asin(r / length(to));
      shadows.push_back({std::clamp(angle_of(to) - a, -half, half), std::clamp(angle_of(to) + a, -half, half), tau});
    }
    double sum = 0, all = 1;
    for (const Shadow& i : shadows)
      for (bool begin : {true, false}) {
        const double s = begin ? i.begin : i.end;
        double others = 1;
        for (const Shadow& j : shadows)
          if (&j != &i && j.begin < s && s <= j.end) others *= j.tau;
        // Shadows that reach past the light's begin are already in force there.
        sum += (begin ? 1 : -1) * (1 - i.tau) * others * (s + half);
      }
    for (const Shadow& i : shadows)
      if (i.end >= half) all *= i.tau;
    sum += 2 * half * all;
    // If two shadows are cut off at the same end of the light, the order of their ends does not matter: F is 0, or they cancel with `all`.
    const PlaneLight light = PlaneWorld(scene).query({10, 50});
    bool tied = false;
    for (const Shadow& i : shadows) tied |= i.end >= half;
    if (!tied) {
      EXPECT_NEAR(light.radiance.x, sum / (2 * pi), 1e-13);
      ++checked;
    }
    EXPECT_NEAR(light.radiance.z, 2 * half / (2 * pi), 1e-13) << "all of it goes through";
    for (PlaneBody& body : scene.bodies) body.transmittance.reset();
    EXPECT_NEAR(light.radiance.y, PlaneWorld(scene).query({10, 50}).radiance.x, 1e-13) << "nothing goes through: the union";
  }
  EXPECT_GE(checked, 20);
}

TEST(PlaneExtras, ABodyThatLetsAllThroughIsNotThere) {
  for (std::uint64_t s = 0; s < 6; ++s) {
    PlaneScene with = random_scene(0, 900 + s), without = with;
    for (std::size_t i = 3; i < 8; ++i) with.bodies[i].transmittance = Vec3d{1, 1, 1};
    without.bodies.erase(without.bodies.begin() + 3, without.bodies.begin() + 8);
    const PlaneWorld a(with), b(without);
    SceneRandom random(s);
    for (int k = 0; k < 20; ++k) {
      const Vec2d p{random.uniform(0, 100), random.uniform(0, 100)};
      EXPECT_LE(difference(a.query(p).radiance, b.query(p).radiance), 1e-12);
    }
  }
}

// With nothing in between, a mirror shows the light at its mirrored place.
TEST(PlaneExtras, AMirrorShowsTheMirroredScene) {
  PlaneBody lamp = lit(plane_circle({30, 60}, 5), {1, 2, 3});
  lamp.light->range = 150;
  PlaneBody other = lamp;
  other.center = {30, -60 + 2 * 20};  // in the line y = 20
  const PlaneWorld with(scene_of({lamp, mirror(line({-1000, 20}, {1000, 20}), {0.5, 1, 0.25})})), apart(scene_of({lamp})),
      seen(scene_of({other}));
  for (Vec2d p : {Vec2d{80, 30}, {10, 90}, {30, 30}, {31, 25}}) {
    const PlaneLight a = with.query(p), b = apart.query(p), c = seen.query(p);
    EXPECT_LE(difference(a.radiance, b.radiance + c.radiance * Vec3d{0.5, 1, 0.25}), 1e-13);
    EXPECT_LE(difference(a.moment_y, b.moment_y + c.moment_y * Vec3d{0.5, 1, 0.25}), 1e-13);
  }
  EXPECT_EQ(with.query({50, 10}).radiance.x, 0) << "behind it";
}

// A face as wide as the sky, lit from all of it: 2 Ki1(h / l), Bickley's function, at the depth h.
TEST(PlaneExtras, LightEntersBodiesAsBickleySays) {
  PlaneScene scene = scene_of({deep(box(-1e5, 0, 2e5, 1e5), 10)});
  scene.suns = {{{1, 1, 1}, -pi / 2, pi / 2}};
  const PlaneWorld world(scene);
  const double ki1 = 0.3282864782;  // Ki1(1)
  EXPECT_NEAR(world.query({50, 10}).radiance.x, 2 * ki1 / (2 * pi), 1e-9);
  EXPECT_NEAR(world.query({50, -10}).radiance.x, 0.5, 1e-9);
  std::printf("2 Ki1(1): off by %.1e; exp(-h/l) times the light without the body is off by %.1e\n",
              std::fabs(world.query({50, 10}).radiance.x - 2 * ki1 / (2 * pi)), std::fabs(0.5 * std::exp(-1) - 2 * ki1 / (2 * pi)));
}

// In the middle of a round light of emission 1 nothing fades; outside of it, a small lamp is dimmed by its distance.
TEST(PlaneExtras, FogDimsByDistance) {
  PlaneScene scene = scene_of({lit(plane_circle({50, 50}, 0.01))});
  scene.fog_density = 0.03;
  const PlaneWorld world(scene);
  EXPECT_NEAR(world.query({50, 50}).radiance.x, 1, 1e-12);
  const double alone = std::asin(0.01 / 40) / pi;
  EXPECT_NEAR(world.query({90, 50}).radiance.x, alone * std::exp(-0.03 * 40), alone * 0.03 * 0.01);
}

// Short segments of constant colour converge to the textured line with the square of their number.
TEST(PlaneExtras, TexturedLinesAreLinearBetweenTexels) {
  const std::vector<Vec3d> texels{{0, 1, 0}, {1, 0, 2}, {0.5, 0.5, 0}, {0, 3, 1}};
  const std::vector<Vec2d> points{{20, 30}, {60, 30}, {60, 50}};
  const PlaneWorld world(scene_of(plane_textured_line(points, texels)));
  const auto at = [&](double s) {
    const double t = s / 60 * 3, k = std::min(std::floor(t), 2.0);
    return texels[static_cast<std::size_t>(k)] * (1 - (t - k)) + texels[static_cast<std::size_t>(k) + 1] * (t - k);
  };
  const auto strips = [&](int count) {
    std::vector<PlaneBody> bodies;
    for (int i = 0; i < count; ++i) {
      const double s0 = 60.0 * i / count, s1 = 60.0 * (i + 1) / count;
      const auto place = [&](double s) { return s <= 40 ? Vec2d{20 + s, 30} : Vec2d{60, 30 + s - 40}; };
      bodies.push_back(lit(line(place(s0), place(s1)), at(0.5 * (s0 + s1))));
    }
    return PlaneWorld(scene_of(bodies));
  };
  const PlaneWorld coarse = strips(240), fine = strips(960);
  for (Vec2d p : {Vec2d{40, 60}, {70, 20}, {50, 40}, {90, 90}}) {
    const Vec3d exact = world.query(p).radiance;
    const double off = difference(exact, coarse.query(p).radiance), closer = difference(exact, fine.query(p).radiance);
    EXPECT_LE(off, 2e-5);
    EXPECT_LE(closer, off / 12 + 1e-12) << "of the second order: a sixteenth";
  }
  EXPECT_THROW(plane_textured_line({{1, 1}, {1, 1}}, texels), Error);
  EXPECT_THROW(plane_textured_line(points, {}), Error);
}

// The test compares with the cosine, direction by direction, for lamps at an angle above the plane. The result is exact up to the tilt at
// which part of the light arrives from below the surface.
TEST(PlaneExtras, NormalsAreLitByMoments) {
  const double b = 0.7, half = std::asin(0.25), middle = 0.6;  // the light's directions
  const Vec2d lamp = Vec2d{10, 50} + Vec2d{std::cos(middle), std::sin(middle)} * 40;
  const PlaneLight light = PlaneWorld(scene_of({lit(plane_circle(lamp, 10), {3, 2, 1})})).query({10, 50});
  Picture map(1, 1);
  for (const auto& [layer, value] : {std::pair("moment_x", light.moment_x), std::pair("moment_y", light.moment_y)})
    map.layers[layer] = {static_cast<Vec3f>(value)};
  map.pixels[0] = static_cast<Vec3f>(light.radiance);
  double worst = 0;
  for (double tilt : {0.0, 0.3, 0.7, 1.2})
    for (double turn : {0.0, 1.0, 2.5, 4.0}) {
      const Vec3d n{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
      double exact = 0;
      bool above = false, below = false;
      const int count = 20'000;
      for (int i = 0; i < count; ++i) {
        const double f = middle + half * (2 * (i + 0.5) / count - 1);
        const double cosine = std::cos(b) * (n.x * std::cos(f) + n.y * std::sin(f)) + std::sin(b) * n.z;
        (cosine > 0 ? above : below) = true;
        exact += std::max(cosine, 0.0) * 2 * half / count / (2 * pi);
      }
      Picture normals(1, 1);
      normals.pixels[0] = static_cast<Vec3f>(n);
      const double closed =
          std::max(0.0, std::cos(b) * (n.x * light.moment_x.z + n.y * light.moment_y.z) + std::sin(b) * n.z * light.radiance.z);
      const Vec3f drawn = light_normals(map, normals, b).pixels[0];
      EXPECT_NEAR(static_cast<double>(drawn.z), closed, 1e-7);
      EXPECT_NEAR(static_cast<double>(drawn.x), 3 * closed, 3e-7);
      EXPECT_FALSE(tilt <= b && above && below);
      if (above && below) {
        EXPECT_LE(closed, exact + 1e-9) << "too dark, never too bright";
        continue;
      }
      EXPECT_NEAR(closed, exact, 1e-8);
      worst = std::max(worst, std::fabs(closed - exact));
    }
  std::printf("normals: largest error %.1e\n", worst);
  EXPECT_THROW(light_normals(Picture(1, 1), Picture(1, 1), b), Error);
  EXPECT_THROW(light_normals(map, Picture(2, 1), b), Error);
  EXPECT_THROW(light_normals(map, Picture(1, 1), 2), Error);
}

TEST(PlaneExtras, NormalMapsAreDecoded) {
  Picture file(2, 1);
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  file.pixels[0] = Vec3f{static_cast<float>(linear(1)), static_cast<float>(linear(0.5)), static_cast<float>(linear(0.5))} * 0.25f;
  file.layers["alpha"] = {{0.25f, 0.25f, 0.25f}, {0, 0, 0}};
  const Picture normals = normals_of_map(file, true);
  EXPECT_NEAR(normals.pixels[0].x, 1, 1e-6);
  EXPECT_NEAR(normals.pixels[0].y, 0, 1e-6);
  EXPECT_EQ(normals.pixels[1].z, 1);
  Picture plain(1, 1);
  plain.pixels[0] = {0.5f, 1.0f, 0.5f};
  EXPECT_NEAR(normals_of_map(plain, false).pixels[0].y, -1, 1e-6) << "green upwards, y downwards";
}

TEST(PlaneExtras, FramesEqualTheQuery) {
  double worst = 0;
  for (int matter : {1, 2, 4, 8, 16, 20, 22, 31}) {
    const PlaneWorld world(random_scene(matter, static_cast<std::uint64_t>(matter + 3)));
    PlaneFrameOptions options;
    options.width = options.height = 70;
    const Picture frame = render_plane(world, options);
    PlaneFrameOptions with_moments = options;
    with_moments.moments = true;
    const Picture moments = render_plane(world, with_moments);
    for (int y = 0; y < 70; y += 3)
      for (int x = 0; x < 70; x += 3) {
        const Vec2d p{(x + 0.5) / 0.7, (y + 0.5) / 0.7};
        const PlaneLight exact = world.query(p);
        const Vec3f value = frame.at(x, y),
                    moment = moments.layers.at("moment_x")[static_cast<std::size_t>(y) * 70 + static_cast<std::size_t>(x)];
        const double off = difference({value.x, value.y, value.z}, exact.radiance);
        worst = std::max(worst, off);
        EXPECT_LE(off, 2e-5) << "matter " << matter << " at (" << p.x << ", " << p.y << ")";
        EXPECT_LE(difference({moment.x, moment.y, moment.z}, exact.moment_x), 1e-6);
      }
  }
  std::printf("frames with extras: largest difference from the query %.1e\n", worst);
}

// After any sequence of changes, to every kind of body, the stage's picture equals the cold frame's, byte for byte. Tiles that a change
// does not reach are not drawn again.
TEST(PlaneExtras, StagesDrawWhatAChangeReaches) {
  for (int matter : {0, 1, 2, 4, 8, 16, 22, 31}) {
    SceneRandom random(static_cast<std::uint64_t>(matter + 50));
    PlaneScene scene = random_scene(matter, static_cast<std::uint64_t>(matter + 12));
    for (PlaneBody& body : scene.bodies)
      if (body.light) body.light->range = 30;
    if (matter == 22) scene.suns.pop_back();  // no sun without width, which mirrors may show anywhere
    PlaneFrameOptions options;
    options.width = options.height = 80;
    PlaneStage stage(scene, options);
    std::size_t drawn = 0, all = 0;
    for (int step = 0; step < test::by_day_or_night(5, 10); ++step) {
      const Picture& picture = stage.draw();
      const Picture cold = render_plane(PlaneWorld(stage.scene()), options);
      for (std::size_t i = 0; i < cold.pixels.size(); ++i)
        ASSERT_EQ(std::memcmp(&picture.pixels[i], &cold.pixels[i], sizeof(Vec3f)), 0)
            << "matter " << matter << ", step " << step << ", pixel " << i % 80 << ", " << i / 80 << ": " << picture.pixels[i].x
            << ", cold " << cold.pixels[i].x;
      if (step > 0) drawn += stage.stats().drawn, all += stage.stats().tiles;
      for (int changes = step % 6 == 5 ? 3 : 1; changes > 0; --changes) {
        const std::size_t count = stage.scene().bodies.size(), i = static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
        const Vec2d by{random.uniform(-9, 9), random.uniform(-9, 9)};
        switch (static_cast<int>(random.uniform() * 6)) {
          case 0: stage.add(random_scene(matter, static_cast<std::uint64_t>(step)).bodies[static_cast<std::size_t>(3 + step % 9)]); break;
          case 1:
            if (count > 10) stage.remove(i);
            break;
          case 2:
            if (stage.scene().bodies[i].light) stage.recolour(i, {random.uniform(), 1, 0.5});
            break;
          default: stage.move(i, by);
        }
      }
    }
    std::printf("matter %2d: %.1f %% of the tiles drawn again\n", matter, 100.0 * static_cast<double>(drawn) / static_cast<double>(all));
    // Suns and their mirrors reach far.
    if (matter < 16) {
      EXPECT_LT(drawn, all * 2 / 3);
    }
  }
}

TEST(PlaneExtras, StagesFollowAnotherSky) {
  PlaneScene scene = random_scene(16, 12), other = scene;
  other.suns[0].direction += 0.3;
  other.fog_density = 0.01;
  PlaneFrameOptions options;
  options.width = options.height = 40;
  PlaneStage stage(scene, options);
  for (const PlaneScene& next : {other, scene, random_scene(0, 12), other}) {
    stage.draw();
    stage.follow(next);
    EXPECT_TRUE(stage.draw().pixels == render_plane(PlaneWorld(next), options).pixels);
  }
}

TEST(PlaneExtras, WhatKnowsNothingOfThemNamesThem) {
  PlaneScene scene = scene_of({lit(plane_circle({50, 50}, 5)), mirror(box(10, 10, 5, 5))});
  scene.bodies[1].name = "glass";
  const PlaneWorld world(scene);
  const auto problem = [](auto&& job) -> std::string {
    try {
      job();
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(problem([&] { PlaneBounces bounces(world); }).find("'glass', a mirror"), std::string::npos);
  EXPECT_NE(problem([&] { world.query({1, 1}, PlaneMethod::par); }).find("'glass', a mirror"), std::string::npos);
  EXPECT_NE(problem([&] { world.query({1, 1}, PlaneMethod::marched); }).find("use exact or sampled"), std::string::npos);
  EXPECT_EQ(problem([&] { world.query({1, 1}, PlaneMethod::sampled); }), "");
}

TEST(PlaneExtras, ValuesThatMeanNothingAreRefused) {
  const auto refused = [](auto&& change) {
    PlaneScene scene = scene_of({lit(plane_circle({50, 50}, 5)), box(10, 10, 5, 5), plane_circle({80, 80}, 3), line({1, 1}, {9, 1})});
    scene.suns.emplace_back();
    change(scene);
    EXPECT_THROW(PlaneWorld{scene}, Error);
  };
  refused([](PlaneScene& s) { s.bodies[0].transmittance = Vec3d{1, 1, 1}; });
  refused([](PlaneScene& s) { s.bodies[1].transmittance = Vec3d{1, 2, 1}; });
  refused([](PlaneScene& s) { s.bodies[1].mirror = Vec3d{-1, 0, 1}; });
  refused([](PlaneScene& s) { s.bodies[2].mirror = Vec3d{1, 1, 1}; });
  refused([](PlaneScene& s) { s.bodies[3].light_depth = 1; });
  refused([](PlaneScene& s) { s.bodies[1].light_depth = NAN; });
  refused([](PlaneScene& s) { s.bodies[1].light_depth = 1, s.bodies[1].transmittance = Vec3d{}; });
  refused([](PlaneScene& s) { s.fog_density = -1; });
  refused([](PlaneScene& s) { s.suns[0].half_width = 4; });
  refused([](PlaneScene& s) { s.suns[0].direction = INFINITY; });
}

}  // namespace steradian::plane::extras_test
