// Three mirrors that meet in a corner, and two balls before them, against paths.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "night.h"
#include "steradian/render.h"
#include "support/boxes.h"

namespace steradian::mirror_corner_test {
namespace {

using namespace scene;

constexpr int kMirror = 1, kRed = 2;  // materials

Scene corner_scene(bool mirror_ball) {
  Scene scene = closed_box(0.7f, false);
  SurfaceMaterial mirror = grey(0.9f);
  mirror.metallic = 1;
  mirror.roughness = 0;
  SurfaceMaterial red = grey(0.7f);
  red.base_color = {0.7f, 0.2f, 0.15f, 1};
  scene.materials.push_back(mirror);
  scene.materials.push_back(red);
  for (const std::size_t side : {0u, 2u, 4u}) scene.meshes[side].material = kMirror;  // towards -x, -y and -z
  scene.meshes.push_back(ball_mesh({-0.3f, -0.65f, -0.2f}, 0.35f, kRed, 64, 32));
  scene.meshes.push_back(ball_mesh({0.45f, -0.7f, -0.45f}, 0.3f, mirror_ball ? kMirror : 0, 64, 32));
  AreaLight lamp;
  Polygon square;
  square.vertices = {{-0.15, 0.98, -0.15}, {0.35, 0.98, -0.15}, {0.35, 0.98, 0.35}, {-0.15, 0.98, 0.35}};
  lamp.shape = square;
  lamp.radiance = {40, 40, 40};
  scene.area_lights = {lamp};
  scene.cameras = {camera_at({0.75, 0.35, 0.85}, {-0.95, -0.9, -1.25}, 0.9)};
  return scene;
}

// Fraction of the pixels that are within their error and four standard errors of the paths.
double covered(const Picture& picture, const Picture& paths) {
  const std::vector<Vec3f>&error = picture.layers.at("bounce_error"), &bound = picture.layers.at("bounce_bound");
  const std::vector<Vec3f>& variance = paths.layers.at("variance");
  std::size_t within = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const auto one = [&](float Vec3f::*c) {
      return std::fabs(picture.pixels[i].*c - paths.pixels[i].*c) <= error[i].*c + bound[i].*c + 4 * std::sqrt(variance[i].*c);
    };
    within += one(&Vec3f::x) && one(&Vec3f::y) && one(&Vec3f::z);
  }
  return static_cast<double>(within) / static_cast<double>(picture.pixels.size());
}

}  // namespace

// A pixel that shows the edge of something a little beside where the paths meet it may be off. Few paths meet the lamp by way of three
// mirrors and more: where a ball is a mirror too, the variance of less than a thousand says too little.
TEST(MirrorCorner, AgreesWithPaths) {
  for (const bool mirror_ball : {false, true}) {
    if (mirror_ball && !test::is_night()) continue;
    const Scene scene = corner_scene(mirror_ball);
    RenderOptions options;
    options.width = options.height = test::by_day_or_night(12, 48);
    options.bounces = kAllBounces;
    if (mirror_ball) options.reflections = 8;
    const Picture picture = render(scene, options);
    options.method = "sampled";
    options.spp = test::by_day_or_night(768, 1024);
    const double within = covered(picture, render(scene, options));
    std::printf("%s: %.2f %% of the pixels within their error\n", mirror_ball ? "one ball is a mirror, 8 reflections" : "2 reflections",
                100 * within);
    EXPECT_GE(within, test::by_day_or_night(0.97, 0.99)) << mirror_ball;  // a pixel of the few by day is 0.7 %
  }
}

}  // namespace steradian::mirror_corner_test
