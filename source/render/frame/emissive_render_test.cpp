// Surfaces that shine and reflect are not lit by their own light.
#include <gtest/gtest.h>

#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::emissive_render_test {
namespace {

using namespace scene;

// A tilted, shining square alone, with corners that are neither whole numbers nor near the origin. One corner is off its plane by as much
// as the reader accepts for a plane.
Scene panel(bool two_sided, Vec3f at, float half) {
  Scene scene;
  SurfaceMaterial m;
  m.name = "panel";
  m.base_color = {0.6f, 0.4f, 0.2f, 1};
  m.metallic = 0.3f;
  m.roughness = 0.4f;
  m.emissive = {1, 0.9f, 0.8f};
  m.double_sided = two_sided;
  scene.materials = {m};
  const Vec3f x = normalized(Vec3f{1, 0.3f, 0.2f}) * half, y = normalized(cross(Vec3f{0.1f, 0.7f, 1}, x)) * half;
  scene.meshes = {quad_mesh(at - x - y, at + x - y, at + x + y + normalized(cross(x, y)) * (1e-5f * half), at - x + y, 0)};
  scene.meshes[0].triangle_lights = {0, 0};
  AreaLight light;
  light.name = "panel";
  Polygon polygon;
  for (const Vec3f& p : scene.meshes[0].positions) polygon.vertices.push_back(static_cast<Vec3d>(p));
  light.shape = polygon;
  light.two_sided = two_sided;
  light.radiance = static_cast<Vec3d>(m.emissive);
  scene.area_lights = {light};
  return scene;
}

struct Extremes {
  Vec3f least{1e9f, 1e9f, 1e9f}, most{};
};
// Extremes over the pixels that show the panel, seen from its lit side (1) or its back (-1).
Extremes seen(Scene scene, float side, RenderOptions options) {
  const auto& p = scene.meshes[0].positions;
  const auto middle = static_cast<Vec3d>((p[0] + p[2]) * 0.5f), n = static_cast<Vec3d>(scene.meshes[0].normals[0]),
             along = static_cast<Vec3d>(p[1] - p[0]);
  const Vec3d way = n * static_cast<double>(side) * length(along) + along * 0.5;
  scene.cameras = {camera_at(middle + way, -way, 0.3)};  // the panel fills the picture
  options.width = 48;
  options.height = 32;
  Extremes e;
  for (const Vec3f& v : render(scene, options).pixels) {
    e.least = {std::min(e.least.x, v.x), std::min(e.least.y, v.y), std::min(e.least.z, v.z)};
    e.most = {std::max(e.most.x, v.x), std::max(e.most.y, v.y), std::max(e.most.z, v.z)};
  }
  return e;
}

}  // namespace

TEST(EmissiveRender, APanelIsNotLitByItself) {
  for (const Vec3f at : {Vec3f{0, 0, 0}, Vec3f{0.3f, 1.7f, -2.1f}, Vec3f{431.3f, -77.1f, 1013.7f}})
    for (const float half : {0.013f, 1.3f, 70.0f})
      // Without ltc-clipless: its formula does not give zero for a light at the horizon.
      for (const std::string method : {"auto", "ltc", "ltc-compact", "representative-point", "half-vector", "sampled"})
        for (const Shadows shadows : {Shadows::on, Shadows::off}) {
          if (half < 1 && at.z > 100) continue;  // fewer than a thousand floats wide
          RenderOptions options;
          options.method = method;
          options.shadows = shadows;
          options.spp = 4;
          const auto where = ::testing::Message()
                             << method << " at " << at.x << " half " << half << " shadows " << (shadows == Shadows::on);
          const Scene one = panel(false, at, half), two = panel(true, at, half);
          const Extremes back = seen(one, -1, options), front = seen(one, 1, options);
          EXPECT_EQ(back.most, (Vec3f{0, 0, 0})) << where;
          for (const Extremes& lit : {front, seen(two, 1, options), seen(two, -1, options)}) {
            EXPECT_EQ(lit.least, one.materials[0].emissive) << where;
            EXPECT_EQ(lit.most, one.materials[0].emissive) << where;
          }
        }
}

}  // namespace steradian::emissive_render_test
