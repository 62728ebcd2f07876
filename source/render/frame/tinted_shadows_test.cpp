// Shadows of clear meshes, against sampled light that passes their faces one by one.
#include "render/frame/tinted_shadows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/meshes.h"
#include "steradian/environment.h"
#include "steradian/render.h"
#include "support/boxes.h"

namespace steradian::tinted_shadows_test {
namespace {

using namespace scene;

// A lamp above a floor, and a clear mesh between them.
Scene floor_below(const Mesh& clear, const SurfaceMaterial& material) {
  Scene scene;
  SurfaceMaterial floor = grey(0.8f);
  floor.specular = 0;
  scene.materials = {floor, material};
  scene.meshes = {quad_mesh({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}, 0), clear};
  scene.meshes[1].material = 1;
  scene.meshes[1].casts_shadow = false;
  AreaLight lamp;
  Polygon square;
  square.vertices = {{-0.5, 3, -0.5}, {0.5, 3, -0.5}, {0.5, 3, 0.5}, {-0.5, 3, 0.5}};
  lamp.shape = square;
  lamp.radiance = {10, 10, 10};
  scene.area_lights = {lamp};
  scene.bounds_min = {-3, 0, -3};
  scene.bounds_max = {3, 3, 3};
  scene.cameras = {camera_at({0, 0.7, 4}, {0, -0.15, -1}, 0.7)};
  return scene;
}

SurfaceMaterial glass(Vec4f color) {
  SurfaceMaterial m;
  m.name = "glass";
  m.base_color = color;
  m.metallic = 0;
  m.roughness = 0;
  m.transmission = 1;
  m.ior = 1;  // no highlight of the lamp, which samples hardly find
  m.specular = 0;
  return m;
}

}  // namespace

// 1e-4 of the light are the cells of the shadows. One pixel of a hundred may be off: where an edge leaves few samples on one side, they
// underestimate their variance.
TEST(TintedShadows, AgreeWithSampledLight) {
  const Mesh pane = quad_mesh({-0.8f, 1, 0.8f}, {0.8f, 1, 0.8f}, {0.8f, 1.3f, -0.8f}, {-0.8f, 1.3f, -0.8f}, 0);
  SurfaceMaterial veil = glass({0.2f, 0.9f, 0.3f, 0.3f});
  veil.transmission = 0;
  veil.alpha_mode = AlphaMode::blend;
  SurfaceMaterial solid = glass({1, 1, 1, 1});
  solid.solid = true;
  solid.attenuation_color = {0.1f, 0.5f, 0.9f};
  solid.attenuation_distance = 1;
  struct Case {
    const char* name;
    Scene scene;
  };
  const Case cases[] = {{"coloured pane", floor_below(pane, glass({0.9f, 0.5f, 0.1f, 1}))},
                        {"blended pane", floor_below(pane, veil)},
                        {"bubble", floor_below(ball_mesh({0, 1, 0}, 0.5f, 0, 24, 12), glass({0.9f, 0.5f, 0.1f, 1}))},
                        {"solid ball", floor_below(ball_mesh({0, 1, 0}, 0.5f, 0, 24, 12), solid)}};
  for (const Case& c : cases) {
    RenderOptions options;
    options.width = 48;
    options.height = 36;
    options.shadows = Shadows::on;
    const Picture ours = render(c.scene, options);
    options.shadows = Shadows::off;
    const Picture without = render(c.scene, options);
    options.shadows = Shadows::on;
    options.method = "sampled";
    options.spp = 512;
    const Picture sampled = render(c.scene, options);
    std::size_t pixels = 0, within = 0, tinted = 0;
    double worst = 0;
    for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
      if (!(sampled.pixels[i].y > 0)) continue;
      ++pixels;
      const double off = std::fabs(double{ours.pixels[i].y} - double{sampled.pixels[i].y});
      const double sigma = std::sqrt(double{sampled.layers.at("variance")[i].y});
      within += off <= 4 * sigma + 1e-4 * double{without.pixels[i].y} ? 1 : 0;
      tinted += ours.pixels[i].y < 0.95f * without.pixels[i].y ? 1 : 0;
      worst = std::max(worst, off / double{without.pixels[i].y});
    }
    std::printf("%s: %zu of %zu pixels within 4 sigma, %zu in shadow, off by at most %.4f of the light\n", c.name, within, pixels, tinted,
                worst);
    EXPECT_GT(tinted, 40u);
    EXPECT_GE(static_cast<double>(within), 0.99 * static_cast<double>(pixels));
  }
}

// Light that meets no clear mesh is the same as without one.
TEST(TintedShadows, LeaveOtherLightAsItIs) {
  Scene scene =
      floor_below(quad_mesh({-2, 2, -2.9f}, {-1.9f, 2, -2.9f}, {-1.9f, 2.1f, -2.9f}, {-2, 2.1f, -2.9f}, 0), glass({0.5f, 0.5f, 0.5f, 1}));
  RenderOptions options;
  options.width = options.height = 16;
  options.shadows = Shadows::on;
  scene.cameras = {camera_at({0, 1, 3}, {0, -0.3, -1}, 0.4)};
  const Picture with = render(scene, options);
  scene.meshes.pop_back();
  const Picture without = render(scene, options);
  for (std::size_t i = 0; i < with.pixels.size(); ++i)
    EXPECT_NEAR(double{with.pixels[i].x}, double{without.pixels[i].x}, 1e-6 * double{without.pixels[i].x});
}

// A floor in a bubble under a white sky: every ray to the sky passes one face.
TEST(TintedShadows, TintTheSkysLight) {
  Scene scene = floor_below(ball_mesh({0, 0, 0}, 6, 0, 48, 24), glass({0.9f, 0.5f, 0.1f, 1}));
  scene.area_lights.clear();
  scene.environment = std::make_shared<const Environment>(white_environment());
  RenderOptions options;
  options.width = options.height = 16;
  options.shadows = Shadows::on;
  scene.cameras = {camera_at({0, 1, 2}, {0, -0.6, -1}, 0.4)};
  for (const bool metal : {false, true}) {
    scene.materials[0].metallic = metal ? 1.0f : 0.0f;
    scene.materials[0].base_color = metal ? Vec4f{1, 1, 1, 1} : Vec4f{0.8f, 0.8f, 0.8f, 1};
    scene.materials[0].roughness = metal ? 0.1f : 1.0f;  // of an albedo within 1e-3 of 1
    for (const Vec3f& p : render(scene, options).pixels) {
      const float light = metal ? 1.0f : 0.8f;
      ASSERT_NEAR(p.x, 0.9f * light, 1e-3f) << metal;
      ASSERT_NEAR(p.y, 0.5f * light, 1e-3f) << metal;
      ASSERT_NEAR(p.z, 0.1f * light, 1e-3f) << metal;
    }
  }
}

// A floor under a pane that sees a lit ceiling through it, and nothing else: light that reaches it has passed the pane an odd number of
// times.
TEST(TintedShadows, TintLightBetweenSurfaces) {
  const Vec3f tint{0.9f, 0.5f, 0.25f};
  Scene scene = floor_below(quad_mesh({-9, 1, 9}, {9, 1, 9}, {9, 1, -9}, {-9, 1, -9}, 0), glass({tint.x, tint.y, tint.z, 1}));
  scene.meshes.push_back(quad_mesh({-3, 3, 3}, {-3, 3, -3}, {3, 3, -3}, {3, 3, 3}, 0));
  scene.area_lights.clear();
  PunctualLight lamp;
  lamp.intensity = {5, 5, 5};
  lamp.kind = PunctualKind::spot;
  lamp.direction = {0, 1, 0};
  lamp.cos_inner = 0.5;
  lamp.cos_outer = 0.2;
  // Four light the ceiling evenly: places that stand for bright patches would depend on the bounces.
  for (const double x : {-1.5, 1.5})
    for (const double z : {-1.5, 1.5}) {
      lamp.position = {x, 1.1, z};
      scene.punctual_lights.push_back(lamp);
    }
  scene.cameras = {camera_at({0, 0.7, 2}, {0, -0.6, -1}, 0.4)};
  RenderOptions options;
  options.width = options.height = 16;
  options.shadows = Shadows::on;
  const auto light = [&](int bounces) {
    options.bounces = bounces;
    Vec3d sum{};
    for (const Vec3f& p : render(scene, options).pixels) sum += static_cast<Vec3d>(p);
    return sum;
  };
  const Vec3d one = light(1), three = light(3) - one;
  scene.meshes.erase(scene.meshes.begin() + 1);
  const Vec3d plain_one = light(1), plain_three = light(3) - plain_one;
  // Without the pane the patches are a little smaller, which changes the light by less than 1 %.
  const auto expect = [](Vec3d with, Vec3d without, Vec3d ratio) {
    EXPECT_NEAR(with.x / without.x, ratio.x, 0.01 * ratio.x);
    EXPECT_NEAR(with.y / without.y, ratio.y, 0.01 * ratio.y);
    EXPECT_NEAR(with.z / without.z, ratio.z, 0.01 * ratio.z);
  };
  const auto t = static_cast<Vec3d>(tint);
  expect(one, plain_one, t);
  expect(three, plain_three, t * t * t);
}

}  // namespace steradian::tinted_shadows_test
