// Scenes that mirrors, glass and broken meshes make hard: every picture ends, and every pixel is finite and not negative.
#include <gtest/gtest.h>

#include <functional>

#include "steradian/render.h"
#include "support/boxes.h"
#include "support/meshes.h"

namespace steradian::hostile_render_test {
namespace {

using namespace scene;

SurfaceMaterial metal(float roughness) {
  SurfaceMaterial m;
  m.roughness = roughness;
  return m;
}

SurfaceMaterial glass(float ior, float roughness, bool solid) {
  SurfaceMaterial m;
  m.metallic = 0;
  m.roughness = roughness;
  m.ior = ior;
  m.transmission = 1;
  m.solid = solid;
  return m;
}

// A lit, closed room with a lamp that rays do not meet.
Scene room() {
  Scene scene = closed_box(0.7f, false);
  AreaLight lamp;
  lamp.shape = Ellipsoid{{0.3, 0.7, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  lamp.radiance = {20, 20, 20};
  scene.area_lights = {lamp};
  return scene;
}

int add(Scene& scene, const SurfaceMaterial& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

void add_ball(Scene& scene, Vec3f center, float radius, const SurfaceMaterial& material) {
  scene.meshes.push_back(ball_mesh(center, radius, add(scene, material), 24, 12));
  scene.meshes.back().casts_shadow = material.transmission < 0.5f;
}

// A square in the plane z = `z`.
void add_square(Scene& scene, float z, const SurfaceMaterial& material) {
  scene.meshes.push_back(quad_mesh({-0.5f, -0.5f, z}, {0.5f, -0.5f, z}, {0.5f, 0.5f, z}, {-0.5f, 0.5f, z}, add(scene, material)));
  scene.meshes.back().casts_shadow = material.transmission < 0.5f;
}

void expect_finite(const char* name, const std::function<void(Scene&)>& change) {
  SCOPED_TRACE(name);
  Scene scene = room();
  change(scene);
  RenderOptions options;
  options.width = options.height = 24;
  options.quality = Quality::draft;
  options.bounces = kAllBounces;
  options.reflections = 8;
  for (const char* method : {"auto", "sampled"}) {
    options.method = method;
    options.spp = 4;
    double sum = 0;
    for (const Vec3f& p : render(scene, options).pixels) {
      ASSERT_TRUE(is_finite(p) && p.x >= 0 && p.y >= 0 && p.z >= 0) << method;
      sum += static_cast<double>(p.x + p.y + p.z);
    }
    EXPECT_GT(sum, 0) << method;
  }
}

}  // namespace

TEST(Hostile, MirrorsFaceToFace) {
  for (const float roughness : {0.0f, 0.1f, 1.0f})
    expect_finite("mirrors", [&](Scene& s) {
      s.materials.push_back(metal(roughness));
      s.meshes[4].material = s.meshes[5].material = 1;
    });
  expect_finite("mirrors that reflect all light", [](Scene& s) { s.materials[0] = metal(0); });
}

TEST(Hostile, GlassOfAnyKindInGlass) {
  for (const float roughness : {0.0f, 0.4f, 1.0f})
    for (const float ior : {1.0f, 3.0f}) {
      expect_finite("solid in solid", [&](Scene& s) {
        add_ball(s, {0, 0, -0.3f}, 0.5f, glass(1.5f, roughness, true));
        add_ball(s, {0, 0, -0.3f}, 0.3f, glass(ior, 1 - roughness, true));
      });
      expect_finite("the camera in glass", [&](Scene& s) { add_ball(s, {0.1f, 0.2f, 0.6f}, 0.3f, glass(ior, roughness, true)); });
      expect_finite("walls", [&](Scene& s) {
        for (const float z : {0.1f, 0.0f, -0.1f}) add_square(s, z, glass(ior, roughness, false));
      });
    }
}

TEST(Hostile, GlassThatAbsorbsAtOnce) {
  for (const float roughness : {0.0f, 0.4f})
    for (const float distance : {0.0f, 1e-30f})
      expect_finite("absorbing", [&](Scene& s) {
        SurfaceMaterial black = glass(1.5f, roughness, true);
        black.attenuation_distance = distance;
        black.attenuation_color = {0, 0.5f, 1};
        add_ball(s, {0, 0, -0.3f}, 0.4f, black);
      });
}

TEST(Hostile, MeshesWithoutNormalsOrDepth) {
  for (const SurfaceMaterial& m : {metal(0), metal(0.5f), glass(1.5f, 0, false), glass(1.5f, 0.5f, false), glass(1.5f, 0.5f, true)}) {
    expect_finite("no normals", [&](Scene& s) {
      add_ball(s, {0, 0, -0.3f}, 0.4f, m);
      for (Vec3f& n : s.meshes.back().normals) n = {};
    });
    expect_finite("edge-on", [&](Scene& s) {
      s.meshes.push_back(quad_mesh({0.1f, -0.5f, -0.8f}, {0.1f, -0.5f, 0.9f}, {0.1f, 0.8f, 0.9f}, {0.1f, 0.8f, -0.8f}, add(s, m)));
    });
    expect_finite("coincident faces", [&](Scene& s) {
      for (int i = 0; i < 3; ++i) {
        add_square(s, 0, m);
        s.materials.back().double_sided = true;
      }
    });
    expect_finite("no area", [&](Scene& s) {
      add_square(s, 0, m);
      s.meshes.back().positions[1] = s.meshes.back().positions[0];
    });
  }
}

}  // namespace steradian::hostile_render_test
