// Every lobe behind occluders, under every kind of light, in pictures against rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "night.h"
#include "render/surface/camera_rays.h"
#include "steradian/render.h"
#include "support/judged_pictures.h"
#include "support/meshes.h"
#include "support/z_test.h"

namespace steradian::shadow_lobes_test {
namespace {

using scene::quad_mesh;

// The material of a strip of the floor, and the relative error of its lobes' method in a penumbra: a few times the rms in the table of
// methods.
struct Strip {
  std::string name;
  SurfaceMaterial material;
  double error = 2e-4;
};

constexpr float kStripWidth = 0.2f;
constexpr int kBentNormals = 0;  // index of the image

SurfaceMaterial dielectric(float specular, float roughness) {
  SurfaceMaterial m;
  m.base_color = {0.5f, 0.5f, 0.5f, 1};
  m.metallic = 0;
  m.specular = specular;
  m.roughness = roughness;
  return m;
}

SurfaceMaterial metal(float roughness) {
  SurfaceMaterial m = dielectric(1, roughness);
  m.metallic = 1;
  return m;
}

SurfaceMaterial with_lobe(Brdf brdf, double width) {
  SurfaceMaterial m = dielectric(0, 1);
  Material lobe;
  lobe.brdf = brdf;
  lobe.exponent = lobe.axis_exponent = width;
  lobe.alpha_x = lobe.alpha_y = width;
  lobe.albedo = {0.5, 0.5, 0.5};
  lobe.axis = {0, 1, 0.3};
  m.specular_override = {lobe};
  return m;
}

std::vector<Strip> strips() {
  SurfaceMaterial brushed = metal(0.3f), sheen = dielectric(0, 1), coat = dielectric(0, 1), bent_coat = coat, bent = metal(0.35f),
                  bent_under_coat = dielectric(0, 1);
  brushed.anisotropy = 0.6f;
  sheen.sheen_color = {0.6f, 0.6f, 0.6f};
  sheen.sheen_roughness = 0.6f;
  for (SurfaceMaterial* m : {&coat, &bent_coat}) m->base_color = {0, 0, 0, 1};  // only the coat
  for (SurfaceMaterial* m : {&coat, &bent_coat, &bent_under_coat}) {
    m->clearcoat = 1;
    m->clearcoat_roughness = 0.5f;
  }
  for (TextureUse* use : {&bent_coat.clearcoat_normal_texture, &bent.normal_texture, &bent_under_coat.normal_texture})
    use->image = kBentNormals;
  SurfaceMaterial foreshortened = with_lobe(Brdf::phong, 20);
  foreshortened.specular_override[0].foreshortening = true;
  return {{"diffuse", dielectric(0, 1)},
          {"dielectric", dielectric(1, 0.5f), 0.01},
          {"metal", metal(0.35f), 0.02},
          {"brushed metal", brushed, 0.03},
          {"phong", with_lobe(Brdf::phong, 20), 5e-3},
          {"foreshortened phong", foreshortened, 5e-3},
          {"blinn-phong", with_lobe(Brdf::blinn_phong, 30), 0.01},
          {"beckmann", with_lobe(Brdf::beckmann, 0.3), 0.01},
          {"lobe-product", with_lobe(Brdf::lobe_product, 8), 0.05},
          {"sheen", sheen, 0.01},
          {"coat", coat, 0.02},
          {"coat with a normal of its own", bent_coat, 0.02},
          {"bent normals", bent, 0.02},
          {"bent normals under a coat", bent_under_coat, 0.01}};
}

// A floor in strips, and a camera that looks at it from below the occluders: a slanted bar pierced by a plate, and a plate that shares an
// edge with its edge-on neighbour.
Scene scene_of(const std::vector<Strip>& strips) {
  Scene scene;
  const auto count = static_cast<float>(strips.size());
  for (std::size_t i = 0; i < strips.size(); ++i) {
    scene.materials.push_back(strips[i].material);
    const float x = (static_cast<float>(i) - count / 2) * kStripWidth;
    scene.meshes.push_back(quad_mesh({x, 0, 1}, {x + kStripWidth, 0, 1}, {x + kStripWidth, 0, -1}, {x, 0, -1}, static_cast<int>(i)));
  }
  // The normal's z is 0.17, which is across the strips and away from the camera.
  scene.images = {{"bent", 1, 1, {118, 150, 250, 255}}};
  const int gray = static_cast<int>(scene.materials.size());
  scene.materials.push_back(dielectric(0, 1));
  const auto add = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d) { scene.meshes.push_back(quad_mesh(a, b, c, d, gray)); };
  add({-2, 1.1f, 0.1f}, {2, 1.2f, 0.2f}, {2, 1.25f, 0}, {-2, 1.15f, -0.1f});
  add({-2, 1.1f, 0.1f}, {-2, 1.4f, 0.3f}, {2, 1.5f, 0.4f}, {2, 1.2f, 0.2f});
  for (int i = -3; i <= 3; ++i) {
    const float x = 0.4f * static_cast<float>(i);
    add({x, 1.05f, -0.5f}, {x + 0.15f, 1.1f, -0.5f}, {x + 0.1f, 1.3f, 0.5f}, {x - 0.05f, 1.2f, 0.5f});
  }
  scene.cameras = {scene::camera_at({0.2, 0.95, 2.6}, {-0.05, -0.42, -1}, 0.5)};
  return scene;
}

constexpr Vec3d kCenter{0.1, 2, -0.2}, kX{0.9, 0, 0.1}, kZ{0, 0.1, 0.35}, kColor{3, 2, 1};

Polygon panel_shape() { return {{kCenter - kX - kZ, kCenter + kX - kZ, kCenter + kX + kZ, kCenter - kX + kZ}, {}}; }

struct Light {
  std::string name;
  std::vector<AreaLight> area = {};
  std::vector<PunctualLight> punctual = {};
  double error = 0;  // error of the shape's approximation
};

// A textured light whose lobes see almost its mean everywhere: its penumbra is that of an even light to two hundredths.
AreaLight textured_panel(Scene& scene) {
  Image image{"stripes", 8, 1, {}};
  for (std::uint8_t i = 0; i < 8; ++i) {
    const auto c = static_cast<std::uint8_t>(i % 2 == 0 ? 205 : 195);
    image.rgba.insert(image.rgba.end(), {c, c, c, 255});
  }
  AreaLight light{panel_shape(), kColor};
  LightTexture t;
  t.use.image = static_cast<int>(scene.images.size());
  t.use.wrap_u = Wrap::repeat;
  t.origin = kCenter;
  t.du = kX * (0.5 / dot(kX, kX));
  t.dv = kZ * (0.5 / dot(kZ, kZ));
  t.factor = kColor * (255.0 / 200);
  light.texture = t;
  scene.images.push_back(std::move(image));
  return light;
}

// A glowing box: six lights. Its mesh lies between the floor and the lights that face away from it.
std::vector<AreaLight> glowing_box(Scene& scene) {
  SurfaceMaterial m = dielectric(0, 1);
  m.emissive = static_cast<Vec3f>(kColor);
  const int material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(m);
  const Vec3d x{0.5, 0, 0.05}, y{0, 0.2, 0}, z{-0.02, 0, 0.2};
  std::vector<AreaLight> lights;
  const auto face = [&](Vec3d n, Vec3d s, Vec3d t) {
    const Vec3d a = kCenter + n - s - t, b = kCenter + n + s - t, c = kCenter + n + s + t, d = kCenter + n - s + t;
    Mesh mesh = quad_mesh(static_cast<Vec3f>(a), static_cast<Vec3f>(b), static_cast<Vec3f>(c), static_cast<Vec3f>(d), material);
    mesh.triangle_lights.assign(2, static_cast<std::int32_t>(lights.size()));
    scene.meshes.push_back(std::move(mesh));
    lights.push_back({Polygon{{a, b, c, d}, {}}, kColor});
  };
  face(x, y, z);
  face(-x, z, y);
  face(y, z, x);
  face(-y, x, z);
  face(z, x, y);
  face(-z, y, x);
  return lights;
}

std::vector<Light> lights_of(Scene& scene) {
  AreaLight behind{panel_shape(), kColor};
  std::reverse(std::get<Polygon>(behind.shape).vertices.begin(), std::get<Polygon>(behind.shape).vertices.end());
  behind.two_sided = true;
  Polygon ring;
  ring.holes.emplace_back();
  for (int i = 0; i < 9; ++i) {
    const double t = 2 * 3.14159265358979 * i / 9, r = i % 3 == 0 ? 1 : 0.7;
    const Vec3d d = kX * std::cos(t) - kZ * (1.6 * std::sin(t));
    ring.vertices.push_back(kCenter - d * r);
    ring.holes[0].push_back(kCenter - d * 0.35);
  }
  std::reverse(ring.vertices.begin(), ring.vertices.end());
  // It is so small for its distance that elements replace its visible part.
  Polygon far = panel_shape();
  for (Vec3d& v : far.vertices) v = Vec3d{3, 40, 5} + (v - kCenter) * 1.5;
  PunctualLight point{"", PunctualKind::point, {0.3, 2, -0.3}, {0, -1, 0}, {3, 2, 1}};
  PunctualLight spot{"", PunctualKind::spot, {0.3, 2.4, -0.3}, {0, -1, 0}, {5, 4, 3}};
  spot.cos_inner = 0.95;
  PunctualLight sun{"", PunctualKind::directional, {}, normalized(Vec3d{0.1, -1, 0.1}), {3, 2, 1}};
  const auto far_color = kColor * 100.0;
  return {{"panel", {{panel_shape(), kColor}}},
          {"two-sided panel from behind", {behind}},
          {"outline with a hole", {{ring, kColor}}},
          {"far panel", {{far, far_color}}},
          {"textured panel", {textured_panel(scene)}, {}, 0.05},
          {"glowing box", glowing_box(scene)},
          {"disk", {{Ellipse{kCenter, kX, kZ}, kColor}}, {}, 5e-3},
          {"ball", {{Ellipsoid{kCenter, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}, kColor}}, {}, 5e-3},
          {"ellipsoid", {{Ellipsoid{kCenter, {0.8, 0, 0}, {0, 0.3, 0.1}, {0, 0, 0.3}}, kColor}}, {}, 5e-3},
          {"tube", {{Capsule{kCenter - kX, kCenter + kX, 0.15}, kColor}}, {}, 5e-3},
          {"point", {}, {point}},
          {"spot", {}, {spot}},
          {"sun", {}, {sun}}};
}

// The pixels that a strip fills, in a row.
Picture pixels_of(const Picture& picture, const std::vector<std::size_t>& which) {
  Picture result(static_cast<int>(which.size()), 1);
  for (std::size_t i = 0; i < which.size(); ++i) result.pixels[i] = picture.pixels[which[i]];
  for (const auto& [name, layer] : picture.layers)
    for (const std::size_t i : which) result.layers[name].push_back(layer[i]);
  return result;
}

std::vector<std::vector<std::size_t>> pixels_by_strip(const Scene& scene, std::size_t strips, const RenderOptions& options) {
  const CameraRays rays(scene.cameras[0], options.width, options.height);
  std::vector<std::vector<std::size_t>> result(strips);
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const Vec3f d = rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), o = rays.origin();
      if (!(d.y < 0)) continue;
      const Vec3f p = o - d * (o.y / d.y);
      const float strip = p.x / kStripWidth + static_cast<float>(strips) / 2;
      if (strip > 0 && strip < static_cast<float>(strips) && std::fabs(p.z) < 1)
        result[static_cast<std::size_t>(strip)].push_back(static_cast<std::size_t>(y * options.width + x));
    }
  return result;
}

// Every lobe of a surface under the visible part of every kind of light: its mean agrees with rays.
TEST(ShadowedLobes, AgreeWithRaysUnderEveryKindOfLight) {
  const std::vector<Strip> all = strips();
  Scene made = scene_of(all);
  const std::vector<Light> lights = lights_of(made);
  const std::size_t without_box = made.meshes.size() - 6;
  RenderOptions options;
  options.width = 84;
  options.height = 40;
  const auto by_strip = pixels_by_strip(made, all.size(), options);
  for (std::size_t l = 0; l < lights.size(); l += test::by_day_or_night<std::size_t>(2, 1)) {
    const Light& light = lights[l];
    Scene scene = made;
    if (light.name != "glowing box") scene.meshes.resize(without_box);
    scene.area_lights = light.area;
    scene.punctual_lights = light.punctual;
    auto [open, analytic, reference] = judged_pictures(scene, options, 0.05);
    std::size_t parts = 0;
    for (std::size_t i = 0; i < open.pixels.size(); ++i) {
      const float share = reference.pixels[i].x / std::max(open.pixels[i].x, 1e-9f);
      parts += share > 0.05f && share < 0.95f;
    }
    EXPECT_TRUE(light.area.empty() || parts > open.pixels.size() / 40) << light.name << " casts hardly a penumbra: " << parts;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const image::ZTest z = image::z_test(pixels_of(analytic, by_strip[k]), pixels_of(reference, by_strip[k]), all[k].error + light.error);
      EXPECT_GT(z.tested, 100u) << all[k].name;
      EXPECT_GE(z.share(), 0.99) << all[k].name << " under " << light.name << ": worst " << z.worst << " of " << z.threshold;
    }
  }
}

// A plate with holes by its texture's alpha, half of it under the bar. The light through it is estimated by 64 rays, with a standard error
// of at most half an eighth of the light.
TEST(ShadowedLobes, CutOutsLetThroughWhatRaysFind) {
  const std::vector<Strip> all = strips();
  Scene scene = scene_of(all);
  Image holes{"holes", 4, 4, {}};
  for (int i = 0; i < 16; ++i) {
    const auto alpha = static_cast<std::uint8_t>((i + i / 4) % 2 == 0 ? 255 : 0);
    holes.rgba.insert(holes.rgba.end(), {128, 128, 128, alpha});
  }
  SurfaceMaterial m = dielectric(0, 1);
  m.alpha_mode = AlphaMode::mask;
  m.base_color_texture.image = static_cast<int>(scene.images.size());
  m.base_color_texture.filter = Filter::nearest;
  scene.images.push_back(std::move(holes));
  Mesh plate =
      quad_mesh({-2, 1.3f, 0.5f}, {2, 1.3f, 0.5f}, {2, 1.35f, -0.1f}, {-2, 1.35f, -0.1f}, static_cast<int>(scene.materials.size()));
  plate.texcoords[0] = {{0, 0}, {4, 0}, {4, 1}, {0, 1}};
  scene.materials.push_back(m);
  scene.meshes.push_back(plate);
  RenderOptions options;
  options.width = 84;
  options.height = 40;
  const auto by_strip = pixels_by_strip(scene, all.size(), options);
  const AreaLight panel{panel_shape(), kColor}, ball{Ellipsoid{kCenter, {0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}, kColor};
  for (const AreaLight& light : {panel, ball}) {
    scene.area_lights = {light};
    auto [open, analytic, reference] = judged_pictures(scene, options, 0.05);
    // The rays are distributed by the cosine alone, so only the diffuse strip is tested.
    for (std::size_t i = 0; i < open.pixels.size(); ++i)
      reference.layers.at("variance")[i] += open.pixels[i] * open.pixels[i] * (0.25f / 64);
    const image::ZTest z = image::z_test(pixels_of(analytic, by_strip[0]), pixels_of(reference, by_strip[0]), 5e-3);
    EXPECT_GT(z.tested, 100u);
    EXPECT_GE(z.share(), 0.99) << "worst " << z.worst;
    // The mean averages out the noise of both.
    double sum = 0, expected = 0, squares = 0;
    for (const std::size_t i : by_strip[0]) {
      sum += static_cast<double>(analytic.pixels[i].y);
      expected += static_cast<double>(reference.pixels[i].y);
      squares += static_cast<double>(reference.layers.at("variance")[i].y);
    }
    EXPECT_NEAR(sum, expected, 4.5 * std::sqrt(squares) + 5e-3 * expected);
  }

  // A thread forgets the tube of its last picture.
  options.threads = 1;
  options.shadows = Shadows::exact;
  scene.area_lights = {panel};
  const Picture before = render(scene, options);
  scene.area_lights = {{Capsule{kCenter - Vec3d{0.4, 0, 0}, kCenter + Vec3d{0.4, 0, 0}, 0.1}, kColor}};
  render(scene, options);
  scene.area_lights = {panel};
  EXPECT_EQ(before.pixels, render(scene, options).pixels);
}

}  // namespace
}  // namespace steradian::shadow_lobes_test
