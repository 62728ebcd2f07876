#include "render/surface/surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/surface/camera_rays.h"
#include "steradian/closed_form.h"
#include "steradian/render.h"
#include "support/meshes.h"
#include "support/z_test.h"

namespace steradian::surface_test {
namespace {

using namespace scene;

using namespace image;

// A floor at y = 0 with its tangent along x. glTF's bitangent, cross(normal, tangent) w with w = 1, runs along -z.
Scene floor_scene(SurfaceMaterial material) {
  Scene scene;
  scene.materials = {std::move(material)};
  Mesh mesh = quad_mesh({-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}, 0);
  mesh.tangents.assign(4, {1, 0, 0, 1});
  mesh.texcoords[0].assign(4, {0.5f, 0.5f});
  scene.meshes = {mesh};
  return scene;
}

// Adds an image of one texel and returns its use.
TextureUse add_texel(Scene& scene, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  scene.images.push_back({"", 1, 1, {r, g, b, 255}});
  TextureUse use;
  use.image = static_cast<int>(scene.images.size()) - 1;
  return use;
}

Surface seen(const Scene& scene, Vec3f view) { return surface_at(scene, scene.meshes[0], 0, 0.25f, 0.25f, normalized(view)); }

constexpr Vec3f kAbove{0.3f, 1, 0.2f}, kBelow{0.3f, -1, 0.2f};
constexpr float kRounding = 1e-6f;  // a few roundings of unit vectors

void expect_near(Vec3f a, Vec3f b) { EXPECT_LT(length(a - b), kRounding) << a.x << " " << a.y << " " << a.z; }

}  // namespace

TEST(Surface, AnisotropyTurnsCounterClockwiseFromTheTangentOnBothFaces) {
  SurfaceMaterial m;
  m.anisotropy = 0.8f;
  m.anisotropy_rotation = 0.5f;
  const Scene scene = floor_scene(m);
  const Vec3f expected{std::cos(0.5f), 0, -std::sin(0.5f)};
  for (const Vec3f view : {kAbove, kBelow}) {
    const Surface s = seen(scene, view);
    expect_near(s.normal, {0, view.y > 0 ? 1.0f : -1.0f, 0});
    EXPECT_NEAR(std::fabs(dot(s.tangent, expected)), 1, kRounding);  // a lobe's axis has no sign
  }
}

TEST(Surface, ABackFaceReversesTheNormalOfItsNormalMap) {
  Scene scene = floor_scene({});
  scene.materials[0].normal_texture = add_texel(scene, 170, 200, 220);
  const Vec3f front = seen(scene, kAbove).normal;
  const Vec3f x{1, 0, 0}, y{0, 0, -1}, z{0, 1, 0};
  expect_near(front, normalized(x * (170 / 127.5f - 1) + y * (200 / 127.5f - 1) + z * (220 / 127.5f - 1)));
  expect_near(seen(scene, kBelow).normal, -front);
}

TEST(Surface, TheCoatHasANormalOfItsOwn) {
  Scene scene = floor_scene({});
  SurfaceMaterial& m = scene.materials[0];
  m.clearcoat = 1;
  m.normal_texture = add_texel(scene, 200, 128, 200);
  expect_near(seen(scene, kAbove).coat_normal, {0, 1, 0});
  EXPECT_GT(seen(scene, kAbove).normal.x, 0.4f);

  m.clearcoat_normal_texture = add_texel(scene, 128, 60, 220);
  m.clearcoat_normal_texture.scale = 0.5f;
  const Vec3f coat = normalized(Vec3f{0.5f * (128 / 127.5f - 1), 220 / 127.5f - 1, -0.5f * (60 / 127.5f - 1)});
  expect_near(seen(scene, kAbove).coat_normal, coat);
  expect_near(seen(scene, kBelow).coat_normal, -coat);
  m.normal_texture = {};
  expect_near(seen(scene, kAbove).normal, {0, 1, 0});
}

TEST(Surface, ANormalThatTurnsAwayFromTheViewerIsTurnedBack) {
  Scene scene = floor_scene({});
  scene.materials[0].normal_texture = add_texel(scene, 10, 128, 160);  // leans towards -x
  const Vec3f bent = seen(scene, {0, 1, 0}).normal;
  ASSERT_LT(bent.x, -0.9f);
  for (float elevation = 0.02f; elevation < 3; elevation *= 1.1f) {
    const Vec3f view = normalized(Vec3f{1, elevation, 0});
    const Vec3f n = seen(scene, view).normal;
    EXPECT_GT(dot(n, view), 0) << elevation;
    EXPECT_NEAR(length(n), 1, kRounding);
    if (dot(bent, view) > 0.01f) {
      expect_near(n, bent);
    } else {
      EXPECT_LT(dot(n, view), 0.05f) << elevation;  // no further than needed: a hundredth over the length of the rest
    }
  }
  scene.materials[0].normal_texture = {};
  expect_near(seen(scene, {1, 1e-4f, 0}).normal, {0, 1, 0});
}

// A black base under a coat, each with its own bent normal: pixels show the coat alone, by the library's own call.
TEST(Surface, PicturesShowTheCoatAboutItsOwnNormal) {
  Scene scene = floor_scene({});
  SurfaceMaterial& m = scene.materials[0];
  m.base_color = {0, 0, 0, 1};
  m.metallic = 1;
  m.roughness = 0.3f;
  m.clearcoat = 0.9f;
  m.clearcoat_roughness = 0.4f;
  m.normal_texture = add_texel(scene, 60, 128, 220);
  m.clearcoat_normal_texture = add_texel(scene, 128, 90, 250);
  AreaLight light;
  light.shape = Polygon{{{-1, 2, -3}, {1, 2, -3}, {1, 2, -1}, {-1, 2, -1}}, {}};
  light.radiance = {5, 4, 3};
  scene.area_lights = {light};
  Camera camera;
  camera.position = {0, 3, 4};
  camera.z = normalized(Vec3d{0, 3, 4});
  camera.y = cross(camera.z, camera.x);
  scene.cameras = {camera};
  RenderOptions options;
  options.width = 40;
  options.height = 24;
  const Picture picture = render(scene, options);

  Material coat;
  coat.brdf = Brdf::ggx;
  coat.alpha_x = coat.alpha_y = 0.16;
  coat.f0 = Vec3d{0.04, 0.04, 0.04} * 0.9;
  coat.f90 = Vec3d{0.9, 0.9, 0.9};
  const auto normal = static_cast<Vec3d>(seen(scene, kAbove).coat_normal);
  const CameraRays rays(camera, options.width, options.height);
  double worst = 0, largest = 0;
  for (int y = 4; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const auto d = static_cast<Vec3d>(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      const Vec3d p = camera.position - d * (camera.position.y / d.y);
      if (std::fabs(p.x) > 7.9 || std::fabs(p.z) > 7.9) continue;
      // The base is a black metal, but a metal's F90 is 1: it is visible at grazing angles, dimmed by the coat.
      const Surface s = seen(scene, static_cast<Vec3f>(-d));
      Material base = coat;
      base.alpha_x = base.alpha_y = static_cast<double>(s.alpha_x);
      base.f0 = {};
      base.f90 = static_cast<Vec3d>(s.f90);
      const PreparedPolygon polygon = prepare_polygon(flat_polygon(light));
      const double expected = closed_form_radiance(polygon, {p, normalized(normal), normalized(-d)}, coat).x +
                              closed_form_radiance(polygon, {p, normalized(static_cast<Vec3d>(s.normal)), normalized(-d)}, base).x;
      worst = std::max(worst, std::fabs(static_cast<double>(picture.at(x, y).x) - expected));
      largest = std::max(largest, expected);
    }
  EXPECT_LT(worst, 5e-5);  // radiance up to 5 in float: hit points to 2e-6 of 10 m, lobes to 1e-5 (docs/measured/accuracy.md)
  EXPECT_GT(largest, 0.03);
  std::printf("largest error of the radiance %.1e of %.2f\n", worst, largest);

  options.method = "reference";
  options.target_error = 0.04;
  const Picture reference = render(scene, options);
  // Three times the closed form's own error with Fresnel, of rms 0.0021 (docs/measured/accuracy.md).
  const ZTest test = z_test(picture, reference, 0.0063);
  EXPECT_GE(test.share(), 0.9975) << test.tested << " tested, worst " << test.worst << " sigma, threshold " << test.threshold;
}

}  // namespace steradian::surface_test
