// Pictures within a time limit: whatever the time allows, the layer "shadow_bound" holds, and enough time gives the exact picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "paths.h"
#include "render/lights/light_choice.h"
#include "render/shadow/few_rays.h"
#include "steradian/area_light.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::time_limit_test {
namespace {

Picture picture_of(const Scene& scene, double limit, RenderStats& stats) {
  RenderOptions options;
  options.width = 160;
  options.height = 90;
  options.aa = 2;
  options.shadows = Shadows::on;
  options.shadow_error = 0;
  options.time_limit = limit;
  return render(scene, options, &stats);
}

}  // namespace

TEST(TimeLimit, EveryPixelIsWithinItsBound) {
  for (const char* name : {"gallery.glb", "room.glb", "tubes.glb"}) {
    const Scene scene = load_scene(test::kSourceDir + "/scenes/" + name).scene;
    RenderStats stats;
    const Picture exact = picture_of(scene, 0, stats);
    for (const double limit : {1e-9, 0.02, 0.1, 0.4}) {
      const Picture limited = picture_of(scene, limit, stats);
      const std::vector<Vec3f>& bound = limited.layers.at("shadow_bound");
      double most = 0;
      for (std::size_t i = 0; i < bound.size(); ++i) {
        const Vec3f a = limited.pixels[i], b = exact.pixels[i];
        ASSERT_TRUE(is_finite(a));
        for (const auto [value, truth, of] : {std::array{a.x, b.x, bound[i].x}, {a.y, b.y, bound[i].y}, {a.z, b.z, bound[i].z}}) {
          // A visible part sends at most what the whole sends, up to the error of the method: 1 % of GGX, in docs/methods.md.
          EXPECT_LE(std::fabs(value - truth), of * 1.01f + 1e-5f) << name << " limit " << limit << " pixel " << i;
          most = std::max(most, static_cast<double>(of));
        }
      }
      std::printf("%s, %g s: %.0f %% exact, estimated error %.2f %%, largest bound %.2g\n", name, limit, 100 * stats.exact_tiles,
                  100 * stats.estimated_shadow_error, most);
    }
  }
}

TEST(TimeLimit, EnoughTimeGivesTheExactPicture) {
  const Scene scene = load_scene(test::kSourceDir + "/scenes/gallery.glb").scene;
  RenderStats stats;
  const Picture exact = picture_of(scene, 0, stats), limited = picture_of(scene, 1e6, stats);
  EXPECT_EQ(stats.exact_tiles, 1);
  EXPECT_EQ(stats.estimated_shadow_error, 0);
  EXPECT_EQ(limited.pixels, exact.pixels);
  for (const Vec3f& bound : limited.layers.at("shadow_bound")) EXPECT_EQ(bound, Vec3f{});
}

// A strong light and thirty dim ones over boxes. Together with the dimmer ones, some lights send less than the permitted fraction.
Scene scene_of_dim_lights() {
  Scene scene = scene::floor_scene(SurfaceMaterial{}, 3, {0, 3, 5});
  for (int i = 0; i < 9; ++i) {
    const float x = static_cast<float>(i % 3) - 1, z = static_cast<float>(i / 3) - 1;
    scene.meshes.push_back(scene::quad_mesh({x, 0.3f, z}, {x + 0.4f, 0.3f, z}, {x + 0.4f, 0.5f, z + 0.4f}, {x, 0.5f, z + 0.4f}, 0));
  }
  for (int i = 0; i <= 30; ++i) {
    AreaLight light;
    const double angle = 0.7 * i, r = i == 0 ? 0 : 2.5;
    light.shape = Ellipse{{r * std::cos(angle), i == 0 ? 3 : 1.5, r * std::sin(angle)}, {0.2, 0, 0}, {0, 0, 0.2}};
    const float radiance = i == 0 ? 100 : 2 * std::exp(-0.3f * static_cast<float>(i));
    light.radiance = {radiance, radiance, 0.5 * static_cast<double>(radiance)};
    light.two_sided = true;
    scene.area_lights.push_back(std::move(light));
  }
  return scene;
}

TEST(ShadowError, EveryPixelIsWithinItsBoundAndTheBoundWithinTheError) {
  const Scene scene = scene_of_dim_lights();
  RenderOptions options;
  options.width = 160;
  options.height = 90;
  options.shadows = Shadows::on;
  options.shadow_error = 0;
  RenderStats stats;
  const Picture exact = render(scene, options, &stats);
  EXPECT_EQ(stats.shadows_estimated, 0);
  EXPECT_EQ(exact.layers.count("shadow_bound"), 0u);
  double estimated = 0;
  for (const double error : {1e-3, 1e-2, 0.1}) {
    options.shadow_error = error;
    const Picture picture = render(scene, options, &stats);
    const std::vector<Vec3f>& bound = picture.layers.at("shadow_bound");
    for (std::size_t i = 0; i < bound.size(); ++i) {
      const Vec3f a = picture.pixels[i], b = exact.pixels[i], of = bound[i];
      // Sums of 31 lights in float are off by 31 roundings.
      const float rounding = 2e-6f * std::max({b.x, b.y, b.z});
      for (const auto [value, truth, most] : {std::array{a.x, b.x, of.x}, {a.y, b.y, of.y}, {a.z, b.z, of.z}})
        ASSERT_LE(std::fabs(value - truth), most * 1.01f + rounding) << error << " pixel " << i;
      ASSERT_LE(std::max({of.x, of.y, of.z}), static_cast<float>(error) * std::max({a.x, a.y, a.z}) + rounding) << error << " pixel " << i;
    }
    EXPECT_GT(stats.shadows_estimated, estimated);  // a larger error leaves more to rays
    estimated = stats.shadows_estimated;
  }
}

// A net of lights of different radiance and kind over boxes.
Scene scene_of_many_lights() {
  Scene scene = scene_of_dim_lights();
  scene.area_lights.clear();
  for (int i = 0; i < 400; ++i) {
    AreaLight light;
    const Vec3d at{0.3 * (i % 20) - 3, 2, 0.3 * (i / 20) - 3};
    if (i % 3 == 0)
      light.shape = Ellipsoid{at, {0.05, 0, 0}, {0, 0.05, 0}, {0, 0, 0.05}};
    else
      light.shape = Ellipse{at, {0.05, 0, 0}, {0, 0, 0.05}};
    light.two_sided = i % 3 == 1;
    const double radiance = 1 + i % 7;
    light.radiance = {radiance, radiance, 0.5 * radiance};
    scene.area_lights.push_back(std::move(light));
  }
  return scene;
}

// 16 lights of each tile in the first picture, more where there is time. With the lights' order reversed, others are met.
TEST(TimeLimit, AFewOfManyLightsFindTheShadowsOfAll) {
  Scene scene = scene_of_many_lights();
  for (const bool reversed : {false, true}) {
    if (reversed) std::reverse(scene.area_lights.begin(), scene.area_lights.end());
    RenderStats stats;
    const Picture exact = picture_of(scene, 0, stats);
    const Picture limited = picture_of(scene, 0.5e-3 * stats.total_ms, stats);
    ASSERT_LT(stats.exact_tiles, 0.9);
    const std::vector<Vec3f>&bound = limited.layers.at("shadow_bound"), &sum_bound = limited.layers.at("light_bound");
    double difference = 0, light = 0, shadow = 0;
    const Picture bright = [&] {
      RenderOptions options;
      options.width = 160;
      options.height = 90;
      options.aa = 2;
      options.shadows = Shadows::off;
      return render(scene, options, nullptr);
    }();
    for (std::size_t i = 0; i < bound.size(); ++i) {
      const Vec3f a = limited.pixels[i], b = exact.pixels[i];
      for (const auto [value, truth, of, sum] : {std::array{a.x, b.x, bound[i].x, sum_bound[i].x},
                                                 {a.y, b.y, bound[i].y, sum_bound[i].y},
                                                 {a.z, b.z, bound[i].z, sum_bound[i].z}})
        ASSERT_LE(std::fabs(value - truth), of * 1.01f + 2 * sum + 1e-5f) << i;
      difference += std::pow(luminance(static_cast<Vec3d>(a - b)), 2);
      shadow += std::pow(luminance(static_cast<Vec3d>(bright.pixels[i] - b)), 2);
      light += luminance(static_cast<Vec3d>(a));
    }
    const auto pixels = static_cast<double>(bound.size());
    const double rms = std::sqrt(difference / pixels) / (light / pixels), all = std::sqrt(shadow / pixels) / (light / pixels);
    std::printf("%.0f %% exact, true error %.3f %%, estimated %.3f %%, without shadows %.1f %%\n", 100 * stats.exact_tiles, 100 * rms,
                100 * stats.estimated_shadow_error, 100 * all);
    // The estimate is half the difference of two halves, whose own relative error is large; over all pixels it holds to a factor of two.
    EXPECT_LT(rms, 2 * stats.estimated_shadow_error);
    EXPECT_LT(rms, 0.5 * all);  // 8 or more rays of a pixel know the fraction to a sixth or better
  }
}

// Equal lights at equal distances are met in turn, and any sum over lights of what they send is a sum over the chosen.
TEST(LightChoice, ChosenLightsStandForAll) {
  Scene scene = scene::floor_scene(SurfaceMaterial{}, 3, {0, 3, 5});
  for (int i = 0; i < 12; ++i) {
    AreaLight light;
    const double angle = i * std::numbers::pi / 6;
    light.shape = Ellipsoid{{2 * std::cos(angle), 0, 2 * std::sin(angle)}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
    light.radiance = Vec3d{1, 1, 1} * (i < 6 ? 1.0 : 3.0);
    scene.area_lights.push_back(std::move(light));
  }
  const std::vector<PackLight> lights = prepare_lights(scene);
  std::vector<const PackLight*> pointers;
  for (const PackLight& light : lights) pointers.push_back(&light);
  Box3f around;
  around.add(Vec3f{-0.1f, -0.1f, -0.1f});
  around.add(Vec3f{0.1f, 0.1f, 0.1f});
  const LightChoice choice(lights);
  const auto chosen = choice.choose(pointers, around, 24, 0.5);
  ASSERT_EQ(chosen.size(), 12u);
  double sum = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(chosen[i].times, i < 6 ? 1u : 3u);  // 24 steps over 6 + 18 parts
    sum += chosen[i].weight * static_cast<double>(chosen[i].times) / 24 * chosen[i].light->area->radiance.x;
  }
  EXPECT_NEAR(sum, 24, 1e-9);  // 6 lights of 1 and 6 of 3
}

// A wall hides half of each kind of light from the floor's middle.
TEST(FewRays, FindHalfOfALightOfAnyShape) {
  Scene scene = scene::floor_scene(SurfaceMaterial{}, 2, {0, 2, 2});
  scene.meshes.push_back(scene::quad_mesh({0, 0.5f, 1}, {2, 0.5f, 1}, {2, 0.5f, -1}, {0, 0.5f, -1}, 0));
  const auto add = [&](Shape shape) {
    AreaLight light;
    light.shape = std::move(shape);
    light.radiance = {1, 1, 1};
    scene.area_lights.push_back(std::move(light));
  };
  Polygon square;
  square.vertices = {{-0.3, 1, -0.3}, {0.3, 1, -0.3}, {0.3, 1, 0.3}, {-0.3, 1, 0.3}};
  add(square);
  add(Ellipse{{0, 1, 0}, {0.3, 0, 0}, {0, 0, 0.3}});
  add(Ellipsoid{{0, 1, 0}, {0.3, 0, 0}, {0, 0.2, 0}, {0, 0, 0.3}});
  add(Capsule{{-0.3, 1, 0}, {0.3, 1, 0}, 0.05});
  const RayScene rays(scene);
  const std::vector<PackLight> lights = prepare_lights(scene);
  ASSERT_EQ(lights.size(), 4u);
  const FewRays few(rays, lights);
  auto tile = std::make_unique<SurfaceTile>();
  tile->material.fill(nullptr);
  tile->material[0] = &scene.materials[0];
  TilePoints points;
  points.points.resize(kTilePixels);
  points.points[0].position = {0, 1e-4, 0};
  points.points[0].normal = {0, 1, 0};
  for (const PackLight& light : lights) {
    RayFractions fractions;
    few.find(*tile, points, light, FewRays::kMost, 0, fractions);
    std::printf("light %zu: %.3f, half the difference of the halves %.3f\n", light.index, static_cast<double>(fractions.visible[0]),
                static_cast<double>(fractions.half_difference[0]));
    // 64 places are strips of 1/8: at most one row of 8 lies on the wrong side of the wall's edge.
    EXPECT_NEAR(fractions.visible[0], 0.5, 1.0 / 16 + 0.02) << light.index;
  }
}

}  // namespace steradian::time_limit_test
