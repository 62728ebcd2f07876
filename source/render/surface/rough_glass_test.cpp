// Rough glass: a thin wall against the mirror that it is, white furnaces, and the blurred image against paths.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "steradian/render.h"
#include "support/boxes.h"
#include "support/meshes.h"

namespace steradian::rough_glass_test {
namespace {

using namespace scene;

constexpr int kSide = 32;
const Vec3f kColor{0.8f, 0.5f, 1};

SurfaceMaterial frosted(float roughness) {
  SurfaceMaterial m;
  m.base_color = {kColor.x, kColor.y, kColor.z, 1};
  m.metallic = 0;
  m.roughness = roughness;
  m.specular = 0;
  m.transmission = 1;
  return m;
}

SurfaceMaterial metal(float roughness) {
  SurfaceMaterial m;
  m.base_color = {1, 1, 1, 1};
  m.metallic = 1;
  m.roughness = roughness;
  return m;
}

SurfaceMaterial diffuse(Vec3f color) {
  SurfaceMaterial m;
  m.base_color = {color.x, color.y, color.z, 1};
  m.metallic = 0;
  m.specular = 0;
  return m;
}

// A wall in the plane z = 0, and behind it (z < 0) a lamp and a floor. The camera stands on one side of the wall.
Scene wall_scene(const SurfaceMaterial& wall, float floor, double side) {
  Scene scene;
  scene.materials = {wall, diffuse({floor, floor, floor})};
  scene.meshes = {quad_mesh({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, 0),
                  quad_mesh({-1, -0.7f, -0.1f}, {1, -0.7f, -0.1f}, {1, -0.7f, -1.5f}, {-1, -0.7f, -1.5f}, 1)};
  scene.meshes[0].casts_shadow = false;
  AreaLight lamp;
  lamp.shape = Ellipsoid{{0.4, 0.5, -0.8}, {0.2, 0, 0}, {0, 0.2, 0}, {0, 0, 0.2}};
  lamp.radiance = {5, 4, 3};
  scene.area_lights = {lamp};
  scene.cameras = {camera_at({0.1, 0.2, 2 * side}, {0, -0.1, -side}, 0.5)};
  scene.bounds_min = {-4, -4, -1.5};
  scene.bounds_max = {4, 4, 0};
  scene.multiple_scattering = true;  // the metal loses no light
  return scene;
}

RenderOptions all_light() {
  RenderOptions options;
  options.width = options.height = kSide;
  options.bounces = kAllBounces;
  return options;
}

// Root of the mean square of a layer, over the mean of the picture.
double rms_of(const Picture& picture, const char* layer, double power) {
  double sum = 0, mean = 0;
  for (const Vec3f& e : picture.layers.at(layer))
    for (const float c : {e.x, e.y, e.z}) sum += std::pow(std::fabs(static_cast<double>(c)), power);
  for (const Vec3f& p : picture.pixels) mean += static_cast<double>(p.x + p.y + p.z);
  const double count = 3.0 * static_cast<double>(picture.pixels.size());
  return std::sqrt(sum / count) / (mean / count);
}

// Root of the mean square of the difference, over the mean.
double difference(const Picture& a, const Picture& b, bool mirrored, Vec3f factor) {
  double squares = 0, sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vec3f truth = b.at(mirrored ? kSide - 1 - x : x, y) * factor, off = a.at(x, y) - truth;
      squares += static_cast<double>(dot(off, off));
      sum += static_cast<double>(truth.x + truth.y + truth.z);
    }
  const double count = kSide * kSide * 3;
  EXPECT_GT(sum, 0);
  return std::sqrt(squares / count) / (sum / count);
}

}  // namespace

// The wall sends on what a mirror of its roughness shows from behind, in its colour.
TEST(RoughGlass, AThinWallIsAMirrorSeenFromBehind) {
  for (const float roughness : {0.1f, 0.22f, 0.4f, 0.8f}) {
    const Picture lamp = render(wall_scene(frosted(roughness), 0, 1), all_light());
    const Picture lamp_mirrored = render(wall_scene(metal(roughness), 0, -1), all_light());
    EXPECT_LT(difference(lamp, lamp_mirrored, true, kColor), 1e-3) << roughness;
    const Picture room = render(wall_scene(frosted(roughness), 0.8f, 1), all_light());
    const Picture room_mirrored = render(wall_scene(metal(roughness), 0.8f, -1), all_light());
    const double off = difference(room, room_mirrored, true, kColor);
    std::printf("roughness %.2f: %.4f of the mean from the mirror\n", static_cast<double>(roughness), off);
    EXPECT_LT(off, 0.03) << roughness;  // one ray stands for 2 x 2 pixels, at another corner of the mirrored ones
  }
}

namespace {

// The difference from paths without their noise, and the picture's own estimate of its error.
struct Off {
  double from_paths = 0, estimated = 0;
};
Off off_from_paths(const Scene& scene, int spp) {
  const Picture picture = render(scene, all_light());
  RenderOptions paths = all_light();
  paths.method = "sampled";
  paths.spp = spp;
  const Picture truth = render(scene, paths);
  const double off = difference(picture, truth, false, {1, 1, 1}), noise = rms_of(truth, "variance", 1);
  const double left = std::sqrt(std::max(off * off - noise * noise, 0.0));
  std::printf("%.4f of the mean from paths, which have noise %.4f; estimated error %.4f\n", left, noise,
              rms_of(picture, "bounce_error", 2));
  return {left, rms_of(picture, "bounce_error", 2)};
}

}  // namespace

TEST(RoughGlass, AThinWallShowsWhatPathsFind) {
  for (const float roughness : {0.15f, 0.5f})
    EXPECT_LT(off_from_paths(wall_scene(frosted(roughness), 0.8f, 1), 1024).from_paths, 0.03) << roughness;
}

// The blurred edge of a dark panel behind a slab and a ball. The picture's own estimate covers the difference. The noise of 128 paths
// hides 1.5 %.
TEST(RoughGlass, ASolidShowsWhatPathsFind) {
  for (const float roughness : {0.15f, 0.3f, 0.5f, 0.8f})
    for (const bool ball : {false, true}) {
      Scene scene = closed_box(0.6f, false);
      scene.materials[0].base_color = {0.8f, 0.5f, 0.3f, 1};
      scene.materials.push_back(frosted(roughness));
      scene.materials.push_back(diffuse({0.1f, 0.1f, 0.1f}));
      scene.materials[1].solid = true;
      const float edge = ball ? 0.01f : 0.1f;  // of a dark panel before the far wall, in the middle of the picture
      scene.meshes.push_back(quad_mesh({-1, -1, -0.95f}, {edge, -1, -0.95f}, {edge, 1, -0.95f}, {-1, 1, -0.95f}, 2));
      AreaLight lamp;
      Polygon polygon;
      polygon.vertices = {{-1, 0.99, -1}, {1, 0.99, -1}, {1, 0.99, 1}, {-1, 0.99, 1}};
      lamp.shape = polygon;
      lamp.radiance = {3, 3, 3};
      lamp.two_sided = true;
      scene.area_lights = {lamp};
      SurfaceMaterial shining = diffuse({0, 0, 0});
      shining.emissive = {3, 3, 3};
      shining.double_sided = true;
      scene.materials.push_back(shining);
      scene.meshes.push_back(quad_mesh({-1, 0.99f, -1}, {1, 0.99f, -1}, {1, 0.99f, 1}, {-1, 0.99f, 1}, 3));
      scene.meshes.back().triangle_lights = {0, 0};
      if (ball) {
        scene.meshes.push_back(ball_mesh({0, 0, -0.3f}, 0.5f, 1, 96, 48));
        scene.meshes.back().casts_shadow = false;
      } else {
        for (const float z : {-0.1f, -0.4f}) {
          Vec3f a{-0.9f, -0.9f, z}, b{0.9f, -0.9f, z}, c{0.9f, 0.9f, z}, d{-0.9f, 0.9f, z};
          scene.meshes.push_back(z > -0.2f ? quad_mesh(a, b, c, d, 1) : quad_mesh(a, d, c, b, 1));
          scene.meshes.back().casts_shadow = false;
        }
      }
      scene.cameras = {camera_at({0.1, 0.1, 0.9}, {0, -0.05, -1}, 0.3)};
      std::printf("roughness %.2f, %s: ", static_cast<double>(roughness), ball ? "ball" : "slab");
      const Off off = off_from_paths(scene, 128);
      // The noise of the paths leaves 0.02 uncertain: 0.12 times the fourth root of 2 over 3,072 values. Wider facets reflect light
      // within, which leaves at other places than where it is shown: no estimate covers that (docs/glass.md).
      EXPECT_LT(off.from_paths, roughness < 0.6f ? off.estimated + 0.02 : 0.6) << roughness;
    }
}

TEST(RoughGlass, AThinWallVanishesInAWhiteFurnace) {
  for (const float roughness : {0.1f, 0.3f, 0.6f, 1.0f}) {
    Scene scene = closed_box(0, true);
    scene.materials.push_back(frosted(roughness));
    scene.meshes.push_back(quad_mesh({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, 1));
    scene.meshes.back().casts_shadow = false;
    scene.cameras = {camera_at({0.1, 0.2, 0.6}, {0.1, -0.3, -1}, 0.9)};
    double worst = 0;
    for (const Vec3f& p : render(scene, all_light()).pixels)
      for (const float off : {p.x - kColor.x, p.y - kColor.y, p.z - kColor.z}) worst = std::max(worst, static_cast<double>(std::fabs(off)));
    std::printf("roughness %.2f: %.5f from 1\n", static_cast<double>(roughness), worst);
    EXPECT_LT(worst, 2e-3) << roughness;
  }
}

}  // namespace steradian::rough_glass_test
