// The CPU is the reference for the device: lobes of extras.steradian, by every method that serves them.
#include "support/device_frames.h"

#include <algorithm>

#include "steradian/error.h"

namespace steradian::vulkan::frame_lobes_test {
namespace {

Material phong(double exponent, bool foreshortening = false) {
  Material m;
  m.brdf = Brdf::phong;
  m.exponent = exponent;
  m.albedo = {0.8, 0.5, 0.3};
  m.foreshortening = foreshortening;
  return m;
}

Material half_vectors(Brdf brdf, double exponent, double alpha_x, double alpha_y) {
  Material m;
  m.brdf = brdf;
  m.exponent = exponent;
  m.alpha_x = alpha_x;
  m.alpha_y = alpha_y;
  return m;
}

Material ggx(double alpha_x, double alpha_y, bool shadowing, Vec3d f0, Vec3d f90) {
  Material m = half_vectors(Brdf::ggx, 1, alpha_x, alpha_y);
  m.shadowing = shadowing;
  m.f0 = f0;
  m.f90 = f90;
  return m;
}

// A floor of strips with one lobe each, beside one of metal.
Scene strips(const std::vector<Material>& lobes) {
  Scene scene;
  for (std::size_t i = 0; i <= lobes.size(); ++i) {
    SurfaceMaterial strip;
    strip.name = "strip " + std::to_string(i);
    strip.base_color = {0.3f, 0.4f, 0.5f, 1};
    strip.metallic = i == lobes.size() ? 1.0f : 0.0f;
    strip.roughness = 0.4f;
    if (i < lobes.size()) strip.specular_override = {lobes[i]};
    scene.materials.push_back(strip);
    const float width = 6.0f / static_cast<float>(lobes.size() + 1), x = width * static_cast<float>(i) - 3;
    scene.meshes.push_back(scene::quad_mesh({x, 0, 2}, {x + width, 0, 2}, {x + width, 0, -2}, {x, 0, -2}, static_cast<int>(i)));
  }
  Camera camera;
  camera.position = {0, 2.5, 5};
  camera.z = normalized(Vec3d{0, 0.4, 1});
  camera.y = {0, camera.z.z, -camera.z.y};
  scene.cameras = {camera};
  return scene;
}

const AreaLight kQuad = light_of(Polygon{{{-2.5, -0.3, -2}, {2.5, -0.3, -2}, {2.5, 1.2, -2.2}, {-2.5, 1.2, -2.2}}, {}}, {3, 2, 1}, true);
const AreaLight kDisk = light_of(Ellipse{{0, 1.8, -1}, {1.5, 0, 0}, {0, 0.1, 0.8}}, {1, 2, 3}, true);

RenderOptions tiny(const std::string& method, Quality quality = Quality::normal) {
  RenderOptions options = small(method);
  options.width = 96;
  options.height = 54;
  options.quality = quality;
  return options;
}

}  // namespace

TEST_F(VulkanFrame, HasPhongLobesBySeriesAndExact) {
  Scene scene = strips({phong(1), phong(6), phong(200), phong(0, true), phong(1, true), phong(60, true)});
  scene.meshes.pop_back();  // the metal, which these methods do not serve
  scene.area_lights = {kQuad};
  expect_same("Phong", scene, tiny("exact"));
  scene.area_lights.push_back(kDisk);
  expect_same("Phong", scene, tiny("series"));
  expect_same("Phong, high", scene, tiny("series", Quality::high));
}

TEST_F(VulkanFrame, LeavesOtherLobesAndMethodsToTheCpu) {
  Material product = phong(20);
  product.brdf = Brdf::lobe_product;
  product.axis_exponent = 30;
  for (const Material& lobe : {half_vectors(Brdf::beckmann, 1, 0.3, 0.3), half_vectors(Brdf::blinn_phong, 80, 1, 1), product}) {
    Scene scene = strips({lobe});
    scene.area_lights = {kQuad};
    expect_rendered_by_cpu(scene, tiny("auto"), std::string("no shader for the ") + name_of(lobe.brdf) + " lobe of material 'strip 0'");
  }
  Scene scene = strips({phong(6)});
  scene.meshes.pop_back();
  scene.area_lights = {kQuad};
  expect_rendered_by_cpu(scene, tiny("arvo"), "no shader for the phong lobe of material 'strip 0'");
}

// GGX with and without the features that its methods need, and sheen, under lights of every shape, including small and far ones.
TEST_F(VulkanFrame, HasOtherLobesUnderEveryShape) {
  const Material cloth = half_vectors(Brdf::charlie, 1, 0.4, 0.4);
  Scene scene =
      strips({ggx(0.2, 0.2, true, {0.9, 0.6, 0.3}, {1, 1, 1}), ggx(0.1, 0.4, true, {0.5, 0.5, 0.5}, {1, 1, 1}),
              ggx(0.3, 0.3, false, {0.7, 0.7, 0.7}, {0.7, 0.7, 0.7}), ggx(0.3, 0.3, false, {0.1, 0.2, 0.3}, {1, 1, 1}), cloth, phong(40)});
  scene.area_lights = {kQuad,
                       kDisk,
                       light_of(Ellipsoid{{-2, 0.6, 0}, {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}}, {2, 2, 1}),
                       light_of(Ellipsoid{{2, 0.9, -1}, {0.3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.2}}, {2, 1, 2}),
                       light_of(Capsule{{-1, 1.2, 0}, {1.5, 0.8, 0.5}, 0.05}, {8, 8, 9}),
                       light_of(Polygon{{{-40, 30, -60}, {-39, 30, -60}, {-39, 31, -60}, {-40, 31, -60}}, {}}, {900, 800, 700})};
  scene.punctual_lights = {punctual(PunctualKind::point, {1, 1.5, 1}, {0, -1, 0})};
  expect_same("every lobe", scene, tiny("auto"));
  EXPECT_EQ(warnings_of(scene, tiny("auto")), std::vector<std::string>());
}

TEST_F(VulkanFrame, HasOwnLobesInPenumbras) {
  Scene scene = strips({phong(40), ggx(0.3, 0.3, true, {0.9, 0.6, 0.3}, {1, 1, 1})});
  scene.meshes.push_back(scene::quad_mesh({-2, 0.6f, 0}, {2, 0.8f, 0.2f}, {2, 0.8f, -0.6f}, {-2, 0.6f, -0.5f}, 2));
  scene.area_lights = {kDisk, light_of(Polygon{{{-1, 2.5, -1}, {-1, 2.5, 1}, {1, 2.5, 1}, {1, 2.5, -1}}, {}}, {3, 2, 1}, true)};
  RenderOptions options = tiny("auto");
  options.shadows = Shadows::on;
  EXPECT_LE(expect_same("lobes, shadows", scene, options), 0.01);
}

// An unlit material beside lobes of extras.steradian has no lobes, whatever its extras say.
TEST_F(VulkanFrame, LightsNothingUnlit) {
  Scene scene = strips({phong(40), ggx(0.4, 0.4, true, {1, 1, 1}, {1, 1, 1}), half_vectors(Brdf::charlie, 1, 0.3, 0.3)});
  scene.area_lights = {kQuad};
  RenderOptions options = tiny("auto");
  options.shadows = Shadows::off;
  for (const std::size_t strip : {1, 2}) scene.materials[strip].unlit = true;
  expect_same("unlit strips", scene, options);
  const Picture cpu = render(scene, options);
  const Vec3f base{0.3f, 0.4f, 0.5f};
  EXPECT_GT(std::count_if(cpu.pixels.begin(), cpu.pixels.end(), [&](Vec3f p) { return length(p - base) < 1e-6f; }), 500);
}

// The device does all of a picture or none. It has no table of the energy that single scattering loses.
TEST_F(VulkanFrame, LeavesPicturesWithLobesThatItLacksToTheCpu) {
  Scene scene = strips({ggx(0.4, 0.4, true, {1, 1, 1}, {1, 1, 1})});
  scene.materials[0].specular_override[0].multiple_scattering = true;
  scene.area_lights = {kQuad};
  expect_rendered_by_cpu(scene, tiny("auto"), "no shader for the ggx lobe of material 'strip 0'");
  EXPECT_THROW(DeviceFrame(scene, tiny("auto")).render(), Error);
}

TEST_F(VulkanFrame, LeavesBentCoatsInShadowToTheCpu) {
  Scene scene = strips({phong(20)});
  SurfaceMaterial& coated = scene.materials[0];
  coated.clearcoat = 1;
  coated.clearcoat_normal_texture.image = 0;
  scene.images.push_back({"bumps", 1, 1, {128, 160, 250, 255}});
  scene.area_lights = {kQuad};
  RenderOptions options = tiny("auto");
  options.shadows = Shadows::on;
  expect_rendered_by_cpu(scene, options, "no shadows for the coat of material 'strip 0'");
}

TEST_F(VulkanFrame, LeavesTintedShadowsToTheCpu) {
  Scene scene = strips({phong(20)});
  SurfaceMaterial pane;
  pane.name = "pane";
  pane.transmission = 1;
  scene.materials.push_back(pane);
  scene.meshes.push_back(scene.meshes[0]);
  scene.meshes.back().material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.back().casts_shadow = false;
  scene.area_lights = {kQuad};
  RenderOptions options = tiny("auto");
  options.shadows = Shadows::on;
  expect_rendered_by_cpu(scene, options, "no shadows of the clear material 'pane'");
}

}  // namespace steradian::vulkan::frame_lobes_test
