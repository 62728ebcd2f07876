// The CPU is the reference for the device: textured lights, and their occluded parts.
#include "fit/table_files.h"
#include "integrals/tables/ggx_tables.h"
#include "support/device_frames.h"

namespace steradian::vulkan::frame_uneven_test {
namespace {

// Profile of a lamp that shines most to the side, and a little upwards.
std::shared_ptr<const LightProfile> lamp_profile() {
  LightProfile p;
  p.vertical = {0, 30, 60, 90, 180};
  p.horizontal = {0, 90, 180};
  p.candela = {5, 8, 4, 1, 0.5, 5, 6, 2, 1, 0, 5, 9, 3, 0, 0};
  return std::make_shared<const LightProfile>(p);
}

AreaLight lamp(Shape shape, Vec3d intensity) {
  AreaLight light = light_of(std::move(shape), {});
  light.name = "lamp";
  set_emission(light, lamp_profile(), {1, 0, 0}, intensity);
  return light;
}

// Strips of roughness 0.05 to 1, one with a coat, one of cloth.
Scene under_lamps() {
  Scene scene;
  for (int i = 0; i < 6; ++i) {
    SurfaceMaterial strip;
    strip.name = "strip";
    strip.metallic = i % 2 == 0 ? 1.0f : 0.2f;
    strip.roughness = std::array{0.05f, 0.15f, 0.3f, 0.5f, 0.7f, 1.0f}[static_cast<std::size_t>(i)];
    if (i == 4) strip.clearcoat = 1, strip.clearcoat_roughness = 0.3f;
    if (i == 5) strip.sheen_color = {0.4f, 0.2f, 0.1f}, strip.sheen_roughness = 0.5f;
    scene.materials.push_back(strip);
    const float x = static_cast<float>(i) - 3;
    scene.meshes.push_back(scene::quad_mesh({x, 0, 2}, {x + 1, 0, 2}, {x + 1, 0, -2}, {x, 0, -2}, i));
  }
  Camera camera;
  camera.position = {0, 2.5, 5};
  camera.z = normalized(Vec3d{0, 0.4, 1});
  camera.y = {0, camera.z.z, -camera.z.y};
  scene.cameras = {camera};
  scene.area_lights = {lamp(Polygon{{{-1.5, 1, -2}, {-1.5, 1, -1}, {-0.5, 1, -1}, {-0.5, 1, -2}}, {}}, {0.3, 0.2, 0.1}),
                       lamp(Ellipse{{1.5, 0.8, -1}, {0.4, 0, 0.2}, {0.1, -0.3, -0.4}}, {0.1, 0.2, 0.3})};
  return scene;
}

// Checkers in three colours.
Image checkers() {
  Image image{"", 32, 32, {}};
  for (int i = 0; i < 32 * 32; ++i)
    for (int c = 0; c < 4; ++c) image.rgba.push_back(c == 3 || ((i % 32) / 4 + i / 128 + c) % 3 == 0 ? 255 : 20);
  return image;
}

AreaLight textured(Polygon shape, Vec3d origin, Vec3d du, Vec3d dv, bool two_sided) {
  AreaLight light = light_of(std::move(shape), {1, 1, 1}, two_sided);
  LightTexture t;
  t.use.image = 0;
  t.origin = origin;
  t.du = du;
  t.dv = dv;
  t.factor = {3, 3, 3};
  light.texture = t;
  return light;
}

}  // namespace

// Surfaces of every roughness under checkers in three colours: cells, halves below the smallest of them, and look-ups in mirrors. There
// are also a coat, a diffuse lobe and a two-sided triangle that the horizon cuts. One light is too long for a direction between its ends.
TEST_F(VulkanFrame, AgreesWithTheCpuUnderTexturedLights) {
  Scene scene;
  scene.images = {checkers()};
  for (int i = 0; i < 6; ++i) {
    SurfaceMaterial strip;
    strip.metallic = i % 2 == 0 ? 1.0f : 0.2f;
    strip.roughness = std::array{0.01f, 0.1f, 0.2f, 0.35f, 0.6f, 1.0f}[static_cast<std::size_t>(i)];
    if (i == 4) strip.clearcoat = 1, strip.clearcoat_roughness = 0.2f;
    scene.materials.push_back(strip);
    const float x = static_cast<float>(i) - 3;
    scene.meshes.push_back(scene::quad_mesh({x, 0, 2}, {x + 1, 0, 2}, {x + 1, 0, -2}, {x, 0, -2}, i));
  }
  Camera camera;
  camera.position = {0, 2.5, 5};
  camera.z = normalized(Vec3d{0, 0.4, 1});
  camera.y = {0, camera.z.z, -camera.z.y};
  scene.cameras = {camera};
  scene.area_lights = {
      textured({{{-1, 0.2, -2}, {1, 0.2, -2}, {1, 2.2, -2}, {-1, 2.2, -2}}, {}}, {-1, 2.2, -2}, {0.5, 0, 0}, {0, -0.5, 0}, false),
      textured({{{2, -0.5, 0}, {2, 1.5, 1}, {2, 1, -1}}, {}}, {2, 0, 0}, {0, 0.7, 0.7}, {0, -0.7, 0.7}, true),
      textured({{{-3000, 3, -1}, {3000, 3, -1}, {3000, 3, 0}, {-3000, 3, 0}}, {}}, {0, 3, 0}, {0.1, 0, 0}, {0, 0, 1}, true)};
  for (const char* method : {"auto", "ltc-compact"}) expect_same("textured lights", scene, small(method));
  EXPECT_EQ(warnings_of(scene, small("auto")), std::vector<std::string>());
}

// The device has profiled points, but no profiled rects and disks.
TEST_F(VulkanFrame, LeavesProfiledRectsAndDisksToTheCpu) {
  expect_rendered_by_cpu(under_lamps(), small("ltc-compact"), "no shader for the profiled light 'lamp'");
}

// The mean of the visible part of a textured light is found on the CPU alone.
TEST_F(VulkanFrame, LeavesTexturedLightsWithShadowsToTheCpu) {
  Scene scene = under_triangles(12);
  scene.images = {checkers()};
  scene.area_lights = {textured(kSquare, {-1, 2.5, -1}, {1, 0, 0}, {0, 0, 1}, true)};
  RenderOptions options = small("ltc-compact");
  options.shadows = Shadows::on;
  expect_rendered_by_cpu(scene, options, "no shadows under the textured light");
}

// The means of textured lights come from the project's own table.
TEST_F(VulkanFrame, LeavesTexturedLightsUnderATableToTheCpu) {
  Scene scene = under_triangles(12);
  scene.images = {checkers()};
  scene.area_lights = {textured(kSquare, {-1, 2.5, -1}, {1, 0, 0}, {0, 0, 1}, true)};
  scene.area_lights[0].name = "lamp";
  RenderOptions options = small("ltc");
  options.shadows = Shadows::off;
  options.table = testing::TempDir() + "frame_uneven_test.json";
  fit::write_files(fit::classic_files(ggx_classic_table(), "another", options.table));
  expect_rendered_by_cpu(scene, options, "no --table under the textured light 'lamp'");
}

TEST_F(VulkanFrame, TheValidationLayerFindsNothingUnderUnevenLights) {
  const auto device = std::make_shared<Device>(DeviceOptions{"", true});
  Scene scene = under_triangles(12);
  scene.images = {checkers()};
  scene.area_lights = {textured(kSquare, {-1, 2.5, -1}, {1, 0, 0}, {0, 0, 1}, true)};
  RenderOptions options = small("ltc-compact");
  options.width = 48;
  options.height = 27;
  options.shadows = Shadows::off;
  DeviceFrame(scene, options, device).render();
  EXPECT_TRUE(device->validation_messages().empty())
      << device->validation_messages().size() << " messages, the first: " << device->validation_messages().front();
}

}  // namespace steradian::vulkan::frame_uneven_test
