// Profiled lights in whole pictures, against sums of points, and against the sampled picture, which evaluates the emission ray by ray.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <tuple>

#include "night.h"
#include "render/direct/lobe_packs.h"
#include "render/frame/uneven_diffuse.h"
#include "render/lights/light_list.h"
#include "render/surface/camera_rays.h"
#include "steradian/radiance.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::profiled_render_test {
namespace {

std::shared_ptr<const LightProfile> lamp_profile() {
  LightProfile p;
  for (int v = 0; v <= 90; v += 5) p.vertical.push_back(v);
  for (int h = 0; h <= 360; h += 30) p.horizontal.push_back(h);
  for (const double h : p.horizontal)
    for (const double v : p.vertical) {
      const double radians = 3.14159265358979324 / 180;
      p.candela.push_back(10 * std::cos(v * radians) *
                          (1 + 2 * std::exp(-(v - 40) * (v - 40) / 300) * (1 + 0.5 * std::cos(2 * h * radians))));
    }
  return std::make_shared<const LightProfile>(p);
}

// A floor at y = 0, seen obliquely from above, and a panel at y = 1.5 that faces down.
Scene lit_floor(bool round, float roughness, float specular) {
  SurfaceMaterial m;
  m.name = "floor";
  m.base_color = {0.6f, 0.6f, 0.6f, 1};
  m.metallic = 0;
  m.roughness = roughness;
  m.specular = specular;
  Scene scene = scene::floor_scene(m, 4, {0, 3, 3}, 0.8);
  AreaLight light;
  light.name = "panel";
  if (round)
    light.shape = Ellipse{{0.2, 1.5, 0}, {0.7, 0, 0}, {0, 0, 0.4}};
  else
    light.shape = Polygon{{{-0.5, 1.5, -0.4}, {0.9, 1.5, -0.4}, {0.9, 1.5, 0.4}, {-0.5, 1.5, 0.4}}, {}};
  set_emission(light, lamp_profile(), {1, 0, 0}, {1, 0.5, 0.25});
  scene.area_lights = {light};
  return scene;
}

RenderOptions small(const std::string& method) {
  RenderOptions options;
  options.width = 40;
  options.height = 24;
  options.shadows = Shadows::off;
  options.method = method;
  return options;
}

TEST(ProfiledRender, DiffuseLightIsTheReferences) {
  for (const bool round : {false, true}) {
    const Scene scene = lit_floor(round, 0.5f, 0);
    const RenderOptions options = small("auto");
    const Picture picture = render(scene, options);
    const CameraRays rays(scene.cameras[0], options.width, options.height);
    Material lambert;
    lambert.albedo = {0.6, 0.6, 0.6};
    double worst = 0;
    for (int y = 1; y < options.height; y += 5)
      for (int x = 1; x < options.width; x += 5) {
        const auto d = static_cast<Vec3d>(rays.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const Vec3d p = scene.cameras[0].position - d * (scene.cameras[0].position.y / d.y);
        if (std::max(std::fabs(p.x), std::fabs(p.z)) > 4) continue;
        const RadianceResult want = radiance(scene.area_lights[0], {p, {0, 1, 0}, {0, 1, 0}}, lambert, {.method = Method::reference});
        const Vec3f got = picture.at(x, y);
        EXPECT_NEAR(got.y, got.x / 2, 1e-6f);
        worst = std::max(worst, std::fabs(static_cast<double>(got.x) / want.radiance.x - 1));
      }
    std::printf("%s: worst %.2e\n", round ? "disk" : "rect", worst);
    EXPECT_GT(worst, 0);
    EXPECT_LT(worst, 3e-3);  // ProfiledLight.ErrorsAreMeasured
  }
}

// The mean is over directions. Light that a boundary keeps back from all of them is in the integral that multiplies the mean.
TEST(ProfiledRender, ABoundaryAboveTheDiffuseLobeLeavesTheMeanAsItIs) {
  const Scene scene = lit_floor(false, 0.5f, 1);
  const std::vector<PackLight> lights = prepare_lights(scene);
  const auto tile = std::make_unique<SurfaceTile>();
  const Vec3f view = normalized(Vec3f{0.9f, 0.3f, 0.1f});
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    tile->material[i] = &scene.materials[0];
    tile->position.x[i] = static_cast<float>(i % 32) / 8 - 2, tile->position.z[i] = static_cast<float>(i / 32) / 8 - 2;
    tile->normal.y[i] = 1;
    tile->view.x[i] = view.x, tile->view.y[i] = view.y, tile->view.z[i] = view.z;
    tile->albedo.x[i] = tile->albedo.y[i] = tile->albedo.z[i] = 1;
  }
  alignas(64) TilePlane irradiance, mean;
  for (const float loss : {0.0f, 1.0f}) {
    tile->fresnel_loss.fill(loss);
    tile->radiance.x.fill(0);
    add_diffuse_from_uneven(*tile, {&lights[0]});
    lobe_packs_for(active_simd())[methods::Procedure::diffuse](lights[0], points_of(*tile), {}, {irradiance.data()});
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      const float now = tile->radiance.x[i] / irradiance[i];
      if (loss > 0) {
        EXPECT_NEAR(now, mean[i], 1e-6f * mean[i]) << i;
      } else {
        mean[i] = now;
      }
    }
  }
}

// Sheen, coat and a custom lobe each use their own mean.
TEST(ProfiledRender, EveryLobeAgreesWithTheSampledPicture) {
  Material phong;
  phong.brdf = Brdf::phong;
  phong.exponent = 20;
  for (const int kind : {0, 1, 2, 3}) {
    Scene scene = lit_floor(kind % 2 == 0, 0.35f, 1);
    SurfaceMaterial& m = scene.materials[0];
    if (kind == 1) m.sheen_color = {0.5f, 0.4f, 0.3f}, m.sheen_roughness = 0.5f;
    if (kind == 2) m.clearcoat = 1, m.clearcoat_roughness = 0.2f;
    if (kind == 3) m.specular_override = {phong};
    const Picture ours = render(scene, small("auto"));
    RenderOptions options = small("sampled");
    options.spp = 512;
    const Picture judged = render(scene, options);
    double a = 0, b = 0, squares = 0, all = 0;
    for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
      const double x = static_cast<double>(ours.pixels[i].x), y = static_cast<double>(judged.pixels[i].x);
      a += x, b += y;
      squares += (x - y) * (x - y), all += y * y;
    }
    std::printf("kind %d: mean %.5f, rms %.2e\n", kind, a / b, std::sqrt(squares / all));
    EXPECT_NEAR(a / b, 1, 5e-3) << kind;  // for 960 pixels with a hundredth of noise each, and the lobes' own error
    EXPECT_LT(std::sqrt(squares / all), 0.03) << kind;
  }
}

// Behind an occluder, the mean is that of the visible part. The rays' noise is most of the difference, so the bounds are twice what is
// measured at each number of samples. The mean of the whole light was 0.07 and 0.25 off.
TEST(ProfiledRender, PenumbrasHaveTheMeanOfTheVisiblePart) {
  const auto narrow = std::make_shared<LightProfile>(*lamp_profile());
  for (std::size_t i = 0; i < narrow->candela.size(); ++i) {
    const double v = narrow->vertical[i % narrow->vertical.size()] / 12;
    narrow->candela[i] = std::exp2(-v * v);
  }
  for (const auto& [name, profile, most] :
       {std::tuple{"bright at 40 degrees", lamp_profile(), test::by_day_or_night(0.03, 0.006)},
        {"half at 12 degrees", std::shared_ptr<const LightProfile>(narrow), test::by_day_or_night(0.16, 0.06)}}) {
    Scene scene = lit_floor(false, 0.5f, 0);
    set_emission(scene.area_lights[0], profile, {1, 0, 0}, {1, 0.5, 0.25});
    scene.meshes.push_back(scene::quad_mesh({0, 0.75f, -0.5f}, {1, 0.75f, -0.5f}, {1, 0.75f, 0.5f}, {0, 0.75f, 0.5f}, 0));
    RenderOptions options = small("auto");
    const Picture open = render(scene, options);
    options.shadows = Shadows::on;
    const Picture ours = render(scene, options);
    options.method = "sampled";
    options.spp = test::by_day_or_night(1024, 16384);
    const Picture judged = render(scene, options);
    double a = 0, b = 0, squares = 0;
    int count = 0;
    for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
      const double whole = static_cast<double>(open.pixels[i].x), x = static_cast<double>(ours.pixels[i].x),
                   y = static_cast<double>(judged.pixels[i].x);
      if (!(whole > 0) || y < 0.05 * whole || y > 0.95 * whole) continue;
      a += x, b += y, ++count;
      squares += (x - y) * (x - y) / (whole * whole);
    }
    ASSERT_GT(count, 50);
    const double rms = std::sqrt(squares / count);
    std::printf("%s, %d pixels: mean %.3f of the sampled, rms %.3f of the light without shadows\n", name, count, a / b, rms);
    EXPECT_LT(rms, most) << name;
  }
}

TEST(ProfiledRender, TheCameraSeesTheEmission) {
  Scene scene = lit_floor(false, 0.5f, 0);
  SurfaceMaterial black;
  black.base_color = {0, 0, 0, 1};
  black.specular = black.metallic = 0;
  black.emissive = static_cast<Vec3f>(scene.area_lights[0].radiance);
  scene.materials.push_back(black);
  Mesh mesh = scene::quad_mesh({-0.5f, 1.5f, -0.4f}, {0.9f, 1.5f, -0.4f}, {0.9f, 1.5f, 0.4f}, {-0.5f, 1.5f, 0.4f}, 1);
  mesh.triangle_lights = {0, 0};
  mesh.is_light_shape = true;
  scene.meshes.push_back(mesh);
  const Camera& camera = scene.cameras[0] = scene::camera_at({0.2, 0.2, 1}, {0, 1.3, -1}, 0.8);
  const RenderOptions options = small("auto");
  const Vec3f seen = render(scene, options).at(20, 12);
  const CameraRays rays(camera, options.width, options.height);
  const Vec3d want = emitted_radiance(*scene.area_lights[0].emission, -normalized(static_cast<Vec3d>(rays.direction(20.5f, 12.5f))));
  EXPECT_NEAR(seen.x, want.x, 1e-5 * want.x);
  EXPECT_GT(std::fabs(want.x / scene.area_lights[0].radiance.x - 1), 0.01) << "not the mean";
}

}  // namespace
}  // namespace steradian::profiled_render_test
