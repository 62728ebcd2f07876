#include "steradian/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/simd.h"
#include "render/cpu/camera_rays.h"
#include "steradian/error.h"

namespace steradian {
namespace {

Mesh quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d, int material) {
  Mesh mesh;
  mesh.material = material;
  mesh.positions = {a, b, c, d};
  const Vec3f n = normalized(cross(b - a, c - a));
  mesh.normals = {n, n, n, n};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

SurfaceMaterial diffuse(float albedo) {
  SurfaceMaterial m;
  m.base_color = {albedo, albedo, albedo, 1};
  m.metallic = 0;
  m.specular = 0;  // no specular lobe: the diffuse lobe gets all of the base colour
  return m;
}

// A floor of albedo 0.5 and a camera above it, looking down at an angle.
Scene floor_scene() {
  Scene scene;
  scene.materials = {diffuse(0.5f)};
  scene.meshes = {quad({-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}, 0)};
  Camera camera;
  camera.name = "main";
  camera.position = {0, 3, 4};
  camera.z = normalized(Vec3d{0, 3, 4});
  camera.x = {1, 0, 0};
  camera.y = cross(camera.z, camera.x);
  scene.cameras = {camera};
  return scene;
}

AreaLight polygon(std::vector<Vec3d> vertices, Vec3d radiance) {
  AreaLight light;
  light.polygon.vertices = std::move(vertices);
  light.polygon.radiance = radiance;
  return light;
}

AreaLight ceiling_light() { return polygon({{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}}, {5, 4, 3}); }
AreaLight wall_light() {  // half below the floor
  return polygon({{-2, -1, -1}, {-2, -1, 1}, {-2, 1.5, 1}, {-2, 1.5, -1}}, {1, 2, 3});
}

RenderOptions small() {
  RenderOptions options;
  options.width = 97;
  options.height = 61;
  return options;
}

Vec3d floor_point(const Scene& scene, const RenderOptions& options, int x, int y) {
  const CameraRays rays(scene.cameras[0], options.width, options.height);
  const auto d = static_cast<Vec3d>(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  const Vec3d o = scene.cameras[0].position;
  return o + d * (-o.y / d.y);
}

}  // namespace

TEST(Render, DiffuseFloorIsThePolygonIntegralAtEveryPixel) {
  Scene scene = floor_scene();
  scene.area_lights = {ceiling_light(), wall_light()};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  double worst = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3d p = floor_point(scene, options, x, y);
      if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
      Vec3d expected{};
      for (const AreaLight& light : scene.area_lights)
        expected += light.polygon.radiance * (polygon_irradiance(prepare_polygon(light.polygon), p, {0, 1, 0}) * 0.5 / M_PI);
      worst = std::max(worst, length(static_cast<Vec3d>(picture.at(x, y)) - expected));
    }
  // Radiance up to 5: float irradiances are good to 5e-7 (docs/accuracy.md), hit points to 2e-6 of 10 m.
  EXPECT_LT(worst, 2e-5);
}

TEST(Render, SphereLightIsItsClosedForm) {
  Scene scene = floor_scene();
  AreaLight sphere;
  sphere.shape = LightShape::sphere;
  sphere.center = {0, 2, 0};
  sphere.x = {0.5, 0, 0};
  sphere.y = {0, 0.5, 0};
  sphere.z = {0, 0, 0.5};
  sphere.polygon.radiance = {2, 2, 2};
  scene.area_lights = {sphere};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  double worst = 0;
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3d p = floor_point(scene, options, x, y);
      if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
      const Vec3d to = sphere.center - p;  // a sphere wholly above the horizon: pi R^2 cos / d^2
      const double irradiance = M_PI * 0.25 * to.y / std::pow(length(to), 3);
      worst = std::max(worst, std::fabs(picture.at(x, y).x / (2 * irradiance * 0.5 / M_PI) - 1));
    }
  EXPECT_LT(worst, 1e-3);  // the 64-gon of equal area
}

TEST(Render, PunctualLightsFollowTheInverseSquare) {
  Scene scene = floor_scene();
  PunctualLight light;
  light.position = {0.5, 2, 0.25};
  light.intensity = {10, 20, 30};
  scene.punctual_lights = {light};
  const RenderOptions options = small();
  const Picture picture = render(scene, options);
  const Vec3d p = floor_point(scene, options, 40, 30), to = light.position - p;
  const double e = to.y / std::pow(length(to), 3) * 0.5 / M_PI;
  EXPECT_NEAR(picture.at(40, 30).z, 30 * e, 30 * e * 1e-5);
}

TEST(Render, GivesTheSameBytesAtAnyNumberOfThreads) {
  Scene scene = floor_scene();
  scene.area_lights = {ceiling_light(), wall_light()};
  RenderOptions options = small();
  options.aa = 3;
  options.threads = 1;
  const Picture one = render(scene, options);
  options.threads = 2;
  EXPECT_EQ(one.pixels, render(scene, options).pixels);
}

TEST(Render, InstructionSetsAgree) {
  Scene scene = floor_scene();
  scene.area_lights = {ceiling_light(), wall_light()};
  Picture first;
  for (Simd simd : available_simd()) {
    setenv("STERADIAN_SIMD", name_of(simd), 1);
    const Picture picture = render(scene, small());
    unsetenv("STERADIAN_SIMD");
    if (first.pixels.empty()) first = picture;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      ASSERT_LT(length(picture.pixels[i] - first.pixels[i]), 2e-5f) << name_of(simd) << " pixel " << i;
  }
}

TEST(Render, LightsBehindTheFloorChangeNothing) {
  Scene scene = floor_scene();
  scene.area_lights = {ceiling_light()};
  const Picture alone = render(scene, small());
  scene.area_lights.push_back(polygon({{-1, -2, -1}, {-1, -2, 1}, {1, -2, 1}, {1, -2, -1}}, {9, 9, 9}));
  EXPECT_EQ(alone.pixels, render(scene, small()).pixels);
}

TEST(Render, AnUnknownCameraIsNamedWithThoseThereAre) {
  RenderOptions options = small();
  options.camera = "nobody";
  try {
    render(floor_scene(), options);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("main"), std::string::npos);
  }
}

}  // namespace steradian
