// Bounds of factors and of light between surfaces: nothing lies outside of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/random.h"
#include "night.h"
#include "paths.h"
#include "render/certificate/bounce_bounds.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::certificate {
namespace {

Vec3d random_place(reference::Random& random, double size) {
  return Vec3d{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5} * size;
}

Vec3d place_in(const OrientedTriangle& t, double u, double v) {
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return t.corners[0] + (t.corners[1] - t.corners[0]) * u + (t.corners[2] - t.corners[0]) * v;
}

bool blocks(const ConvexOccluder& o, Vec3d a, Vec3d b) {
  const double here = dot(a - o.corners[0], o.normal), there = dot(b - o.corners[0], o.normal);
  if (!(here * there < 0)) return false;
  const Vec3d p = a + (b - a) * (here / (here - there));
  for (std::size_t k = 0; k < o.corners.size(); ++k)
    if (dot(cross(o.normal, o.corners[(k + 1) % o.corners.size()] - o.corners[k]), p - o.corners[k]) < 0) return false;
  return true;
}

TEST(FactorRange, NoPointIsOutside) {
  reference::Random random(5);
  std::size_t open = 0, hidden = 0, tested = 0;
  double width = 0;
  for (int round = 0; round < 400; ++round) {
    const double size = round % 2 == 0 ? 0.4 : 1.5;
    const Vec3d from_at = random_place(random, 3), to_at = random_place(random, 3);
    const auto triangle = [&](Vec3d at) {
      return OrientedTriangle::of({at + random_place(random, size), at + random_place(random, size), at + random_place(random, size)});
    };
    const OrientedTriangle from = triangle(from_at), to = triangle(to_at);
    Scene scene;
    scene.materials.resize(1);
    if (round % 4 != 0) {
      const Vec3f m = static_cast<Vec3f>((from_at + to_at) * 0.5), x{round % 4 == 1 ? 4.0f : 0.4f, 0, 0},
                  y{0, round % 4 == 1 ? 4.0f : 0.4f, 0.1f};
      scene.meshes.push_back(scene::quad_mesh(m - x - y, m + x - y, m + x + y, m - x + y, 0));
    }
    const OccluderSet occluders(scene);
    const FactorRange range = factor_range(from, to, occluders, false, 1e-4);
    EXPECT_LE(range.low, range.high);
    for (int k = 0; k < 6; ++k) {
      const Vec3d x = k < 3 ? from.corners[static_cast<std::size_t>(k)] : place_in(from, random.uniform(), random.uniform());
      const double whole = whole_factor(x, from.normal, to);
      double factor = whole, rounding = 1e-12;
      if (!occluders.polygons.empty()) {
        // The mean visible part of the light that a grid of places sends. Near places make it coarse.
        constexpr int kSide = 60;
        double seen = 0, all = 0;
        for (int i = 0; i < kSide * kSide; ++i) {
          const Vec3d y = place_in(to, (i / kSide + 0.5) / kSide, (i % kSide + 0.5) / kSide), r = y - x;
          const double light = std::max(dot(r, from.normal), 0.0) * std::max(-dot(r, to.normal), 0.0) / std::pow(dot(r, r), 2);
          all += light;
          if (!blocks(occluders.polygons[0], x, y)) seen += light;
        }
        factor = all > 0 ? whole * seen / all : 0;
        // A border crosses some 120 of the 3,600 cells, and those near the point send up to three times the mean.
        rounding = seen == all || seen == 0 ? 1e-12 : 0.1 * whole;
      }
      EXPECT_GE(factor, range.low - rounding) << round;
      EXPECT_LE(factor, range.high + rounding) << round;
      if (range.high > 0) ++tested;
    }
    open += range.is_open && range.high > 0 ? 1 : 0;
    hidden += !range.is_open && range.high == 0 ? 1 : 0;
    width += range.high - range.low;
  }
  std::printf("%zu open, %zu hidden; %zu points tested, mean width %.3g\n", open, hidden, tested, width / 400);
  EXPECT_GT(open, 20u);
  EXPECT_GT(hidden, 20u);
  EXPECT_GT(tested, 500u);
}

// A closed box of one albedo: the mean irradiance of all its surfaces is the flux over the area and over 1 - albedo, whatever its shape.
Scene box_with_a_lamp(float albedo) {
  Scene scene;
  SurfaceMaterial wall;
  wall.base_color = {albedo, albedo, albedo, 1};
  wall.metallic = wall.specular = 0;
  scene.materials = {wall};
  const auto add = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d) { scene.meshes.push_back(scene::quad_mesh(a, b, c, d, 0)); };
  add({0, 0, 0}, {0, 0, 2}, {3, 0, 2}, {3, 0, 0});
  add({0, 1, 0}, {3, 1, 0}, {3, 1, 2}, {0, 1, 2});
  add({0, 0, 0}, {0, 1, 0}, {0, 1, 2}, {0, 0, 2});
  add({3, 0, 0}, {3, 0, 2}, {3, 1, 2}, {3, 1, 0});
  add({0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0});
  add({0, 0, 2}, {0, 1, 2}, {3, 1, 2}, {3, 0, 2});
  AreaLight lamp;
  lamp.shape = Polygon{{{1, 1, 0.5}, {2, 1, 0.5}, {2, 1, 1.5}, {1, 1, 1.5}}, {}};
  lamp.radiance = {1, 2, 3};
  scene.area_lights = {lamp};
  scene.cameras = {scene::camera_at({0.2, 0.5, 1}, {1, 0, 0})};
  return scene;
}

TEST(BounceBounds, EncloseTheMeanOfAClosedBox) {
  constexpr double kAlbedo = 0.6, kArea = 22, kFlux = std::numbers::pi;
  const Scene scene = box_with_a_lamp(static_cast<float>(kAlbedo));
  const RayScene rays(scene);
  RenderOptions options;
  options.bounces = kAllBounces;
  double narrower = 1e9;
  for (int k = 0; k < test::by_day_or_night(1, 2); ++k) {
    options.quality = k == 0 ? Quality::draft : Quality::normal;
    BounceBounds::check(scene, options);
    std::size_t steps = 0;
    std::atomic<std::size_t> done = 0;
    const BounceBounds bounds(scene, rays, options, [&] { ++done; });
    steps = BounceBounds::steps(scene, options);
    EXPECT_EQ(done, steps);
    // Means over the walls by a grid of points.
    Vec3d low, high;
    double area = 0;
    for (const Mesh& mesh : scene.meshes) {
      const Vec3d a = static_cast<Vec3d>(mesh.positions[0]), b = static_cast<Vec3d>(mesh.positions[1]) - a,
                  d = static_cast<Vec3d>(mesh.positions[3]) - a;
      constexpr int kSide = 9;
      const double cell = length(cross(b, d)) / (kSide * kSide);
      for (int i = 0; i < kSide * kSide; ++i) {
        const RadianceRange r =
            bounds.white_at(a + b * ((i / kSide + 0.5) / kSide) + d * ((i % kSide + 0.5) / kSide), static_cast<Vec3d>(mesh.normals[0]));
        low += r.low * cell;
        high += r.high * cell;
        area += cell;
      }
    }
    EXPECT_NEAR(area, kArea, 1e-5);
    const double truth = kAlbedo * kFlux / (kArea * (1 - kAlbedo)) / std::numbers::pi;  // of radiance 1, as a white surface reflects it
    std::printf("mean %.5f within %.5f and %.5f\n", truth, low.x / area, high.x / area);
    EXPECT_LT(low.x / area, truth);
    EXPECT_GT(high.x / area, truth);
    EXPECT_NEAR(low.z, 3 * low.x, 1e-6 * low.z);
    EXPECT_NEAR(high.y, 2 * high.x, 1e-6 * high.y);
    EXPECT_LT(high.x - low.x, narrower);  // more elements give a better proof
    narrower = high.x - low.x;
  }
}

TEST(BounceBounds, EncloseThePathsOfTheCornellBox) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/cornell.glb").scene;
  RenderOptions options;
  options.width = 32;
  options.height = 18;
  options.shadows = Shadows::on;
  for (const int bounces : {1, kAllBounces}) {
    options.bounces = bounces;
    options.method = "auto";
    options.quality = Quality::draft;
    options.bound = true;
    options.bounce_strict = true;  // less noise, which leaves narrow bounds
    RenderStats stats;
    const Picture picture = render(scene, options, &stats);
    options.bound = false;
    options.method = "reference";
    options.target_error = 0;
    options.spp = 256;
    const Picture paths = render(scene, options);
    const std::vector<Vec3f>&lower = picture.layers.at("lower"), &upper = picture.layers.at("upper"),
          &variance = paths.layers.at("variance"), &bound = picture.layers.at("bounce_bound");
    std::size_t outside = 0;
    for (std::size_t i = 0; i < lower.size(); ++i) {
      const float sigma = 4 * std::sqrt(variance[i].y), p = paths.pixels[i].y;
      if (p + sigma < lower[i].y || p - sigma > upper[i].y) ++outside;
      EXPECT_LE(lower[i].y, upper[i].y);
      const float rounding = 1e-6f * upper[i].y;
      EXPECT_GE(bound[i].y, upper[i].y - picture.pixels[i].y - rounding);
      EXPECT_GE(bound[i].y, picture.pixels[i].y - lower[i].y - rounding);
    }
    std::printf("%d bounces: %zu sides, half width %.1f %%, %.1f %% inside; %zu of the paths' pixels outside\n", bounces,
                stats.bound_elements, 100 * stats.bound_mean, 100 * stats.bound_inside, outside);
    EXPECT_EQ(outside, 0u);
    EXPECT_GT(stats.bound_inside, 0.99);
    EXPECT_LT(stats.bound_mean, 0.4);
  }
}

TEST(BounceBounds, RefuseWhatHasNoProof) {
  RenderOptions options;
  options.bounces = kAllBounces;
  const auto problem_of = [&](const Scene& scene) -> std::string {
    try {
      BounceBounds::check(scene, options);
    } catch (const UsageError& e) {
      return e.problem();
    }
    return "";
  };
  const Scene box = box_with_a_lamp(0.5f);
  EXPECT_EQ(problem_of(box), "");
  Scene some = box;
  some.materials[0].specular = 1;
  some.materials[0].name = "floor";
  EXPECT_EQ(problem_of(some), "the material \"floor\" has more lobes than the diffuse one");
  some = box;
  some.area_lights[0].shape = Ellipse{{1, 0.9, 1}, {0.1, 0, 0}, {0, 0, 0.1}};
  EXPECT_NE(problem_of(some).find("is no polygon"), std::string::npos);
  some = box;
  some.meshes[0].normals[0] = {1, 0, 0};
  EXPECT_NE(problem_of(some).find("normals"), std::string::npos);
  some = box_with_a_lamp(1);
  EXPECT_NE(problem_of(some).find("reflects all light"), std::string::npos);
}

}  // namespace
}  // namespace steradian::certificate
