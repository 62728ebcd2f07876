// The CPU is the reference for the device: whole frames of the plane.
#include "steradian/plane_device.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>

#include "device/vulkan/device.h"
#include "paths.h"
#include "plane/stage/drawing.h"
#include "steradian/error.h"
#include "steradian/plane_bounce.h"
#include "support/memory.h"
#include "support/plane_families.h"

namespace steradian::plane::plane_device_test {
namespace {

PlaneScene scene_of(const std::string& name) {
  PlaneScene scene = load_plane_scene(test::kSourceDir + "/scenes/plane/" + name + ".svg").scene;
  scene.fit = PlaneFit::stretch;
  return scene;
}

PlaneFrameOptions sized(int width, int height) {
  PlaneFrameOptions options;
  options.width = width;
  options.height = height;
  return options;
}

class VulkanPlane : public ::testing::Test {
 protected:
  void SetUp() override {
    if (vulkan::list_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  }

  // The bound is the interface's: both are within 1e-5 of the query if its light is 1, and without light both are 0.
  void expect_same(const std::string& name, const PlaneScene& scene, PlaneFrameOptions options, double bound = 1e-5) {
    const PlaneWorld world(scene);
    const Picture cpu = render_plane(world, options);
    PlaneFrameStats stats;
    const Picture pictured = device().render(world, options, &stats);
    double squares = 0, errors = 0, largest = 0;
    for (std::size_t i = 0; i < cpu.pixels.size(); ++i) {
      const Vec3f off = pictured.pixels[i] - cpu.pixels[i];
      const auto error = static_cast<double>(dot(off, off));
      ASSERT_TRUE(std::isfinite(error)) << name << " pixel " << i;
      squares += static_cast<double>(dot(cpu.pixels[i], cpu.pixels[i]));
      errors += error;
      largest = std::max(largest, std::sqrt(error));
    }
    const double relative = std::sqrt(errors / std::max(squares, 1e-30));
    const PlaneDeviceStats& d = device().stats();
    std::printf("%-24s relative L2 %.1e, largest %.1e; %zu tiles, %zu of them by the CPU; %.0f ms on the device\n", name.c_str(), relative,
                largest, d.tiles, d.tiles_of_cpu, d.device_ms);
    EXPECT_LE(relative, bound) << name;
    EXPECT_GT(d.tiles, d.tiles_of_cpu) << name << ": the device drew something";
  }

  // Pipelines are created once.
  static PlaneDevice& device() {
    static PlaneDevice device;
    return device;
  }
};

TEST_F(VulkanPlane, DrawsTheProjectsScenesAsTheCpu) {
  for (const char* name : {"lamps", "room", "city"}) expect_same(name, scene_of(name), sized(193, 121));
}

TEST_F(VulkanPlane, DrawsLightFieldsAsTheCpu) {
  LightField field = kLightFields[1];
  field.lights = 12;
  field.boxes = 90;
  field.width = 500;
  field.height = 300;
  expect_same("field", make_light_field(field, 3), sized(500, 300));
  EXPECT_GT(device().stats().lights_listed, 0u);
}

// Every shape with every emission: edges, runs, arcs, spots.
TEST_F(VulkanPlane, DrawsEveryLightAsTheCpu) {
  for (const LightPairDrawing& drawing : all_drawings()) {
    // A software device is slow with outlines of hundreds of edges.
    if (drawing.shape == "stroke" && drawing.emission != "uniform" && drawing.emission != "gradient") continue;
    const PlaneFrameOptions size = drawing.shape == "stroke" || drawing.shape == "curve" ? sized(33, 21) : sized(97, 61);
    // As in PlaneFrame: lights divided by the distance are within 3e-5 close to them.
    expect_same(drawing.shape + "-" + drawing.emission, make_drawing(drawing), size, drawing.emission == "inverse" ? 3e-5 : 1e-5);
  }
}

// If a gradient is a pixel wide or less, roundings of the slopes that bound a light's edges would mix its colours.
TEST_F(VulkanPlane, DrawsSmallGradientsAsTheCpu) {
  PlaneScene scene;
  scene.width = 320;
  scene.height = 200;
  std::vector<Vec2d> outline;
  for (int k = 0; k < 32; ++k) outline.push_back(Vec2d{267, 37} + Vec2d{4 * std::cos(M_PI * k / 16), 3 * std::sin(M_PI * k / 16)});
  PlaneBody light = plane_polygon(outline);
  light.light.emplace();
  light.light->gradient = PlaneGradient{{263, 37}, {271, 37}, {{0, {1, 0, 0}}, {1, {0, 0, 1}}}};
  scene.bodies = {light, plane_polygon({{150, 60}, {230, 60}, {230, 66}, {150, 66}})};
  expect_same("a small gradient", scene, sized(160, 100));
}

// From close to the chord of a run, its far end is visible behind the line of one of its edges; and a line's bend occludes a part that a
// gradient cuts.
TEST_F(VulkanPlane, DrawsBendsAsTheCpu) {
  PlaneScene scene;
  scene.width = scene.height = 80;
  PlaneBody light = plane_polygon({{75, 40}, {30, 25}, {30.2, 27}, {28, 75}, {20, 75}, {20, 15}, {75, 15}});
  light.light.emplace().profile = PlaneProfile::lambert;
  scene.bodies = {light};
  expect_same("a pocket", scene, sized(320, 320));
  PlaneBody line;
  line.shape = PlaneBody::Shape::polyline;
  line.contours = {{{26.6, 77.1}, {38.8, 67.8}, {50.9, 71.1}}};
  line.light.emplace().gradient = PlaneGradient{{55.4, 62.6}, {52, 59.8}, {{0, {1, 0, 0}}, {0.29, {0, 0.25, 1}}, {1, {1, 1, 1}}}};
  scene.bodies = {line};
  expect_same("a bend", scene, sized(320, 320));
}

// Bodies that overlap lights, lie within them, or occlude them: lenses, concave outlines, niches.
TEST_F(VulkanPlane, DrawsEveryFamilyAsTheCpu) {
  for (int family = 1; family <= 10; ++family)
    if (family != 5)  // dark
      expect_same("family " + std::to_string(family), make_plane_family(family, 1), sized(64, 64));
}

TEST_F(VulkanPlane, DrawsBouncesAsTheCpu) {
  const PlaneScene scene = scene_of("bounce");
  const PlaneWorld world(scene);
  PlaneBounceOptions how;
  how.bounces = 2;
  const PlaneBounces bounces(world, how);
  PlaneFrameOptions options = sized(96, 64);
  options.bounces = &bounces;
  const Picture cpu = render_plane(world, options), pictured = device().render(world, options);
  double squares = 0, errors = 0;
  for (std::size_t i = 0; i < cpu.pixels.size(); ++i) {
    const Vec3f off = pictured.pixels[i] - cpu.pixels[i];
    squares += static_cast<double>(dot(cpu.pixels[i], cpu.pixels[i]));
    errors += static_cast<double>(dot(off, off));
  }
  EXPECT_LE(std::sqrt(errors / squares), 1e-5);
}

// More intervals within a light than a thread stores: a comb in front of a long light.
TEST_F(VulkanPlane, LeavesToTheCpuWhatItHasNoRoomFor) {
  PlaneScene scene;
  scene.width = scene.height = 128;
  scene.bodies.push_back(plane_polygon({{2, 2}, {126, 2}, {126, 4}, {2, 4}}));
  scene.bodies.back().light.emplace();
  for (int i = 0; i < 40; ++i) {
    const double x = 4 + 3 * i;
    scene.bodies.push_back(plane_polygon({{x, 10}, {x + 1, 10}, {x + 1, 11}, {x, 11}}));
  }
  expect_same("comb", scene, sized(128, 128));
  EXPECT_GT(device().stats().tiles_of_cpu, 0u);
}

TEST_F(VulkanPlane, KeepsItsBuffersFromFrameToFrame) {
  const PlaneWorld world(scene_of("room"));
  device().render(world, sized(193, 121));
  const std::size_t bytes = device().stats().bytes;
  const Picture first = device().render(world, sized(193, 121)), second = device().render(world, sized(193, 121));
  EXPECT_EQ(device().stats().bytes, bytes);
  EXPECT_EQ(std::memcmp(first.pixels.data(), second.pixels.data(), first.pixels.size() * sizeof(Vec3f)), 0);
}

TEST_F(VulkanPlane, LeavesNothingToTheValidationLayer) {
  std::shared_ptr<const vulkan::Device> validated;
  try {
    validated = std::make_shared<const vulkan::Device>(vulkan::DeviceOptions{"", true});
  } catch (const Error& e) {
    GTEST_SKIP() << e.what();
  }
  PlaneDevice device(validated);
  for (const char* name : {"lamps", "room"}) device.render(PlaneWorld(scene_of(name)), sized(96, 60));
  EXPECT_TRUE(validated->validation_messages().empty()) << validated->validation_messages().front();
}

TEST_F(VulkanPlane, AHundredFramesLeaveMemoryWhereItWas) {
  const PlaneWorld world(scene_of("room"));
  const PlaneFrameOptions options = sized(32, 20);
  Picture picture;
  for (int i = 0; i < 30; ++i) device().render_into(picture, world, options);
  const double before = test::resident_mib();
  for (int i = 0; i < 100; ++i) device().render_into(picture, world, options);
  EXPECT_LE(test::resident_mib(), before + 2);  // 20 KiB a frame
}

TEST_F(VulkanPlane, RefusesWhatItDoesNotHave) {
  const PlaneWorld world(scene_of("lamps"));
  PlaneFrameOptions options = sized(16, 16);
  options.method = PlaneMethod::sampled;
  EXPECT_THROW(device().render(world, options), UsageError);
  options = sized(16, 16);
  options.moments = true;
  EXPECT_THROW(device().render(world, options), UsageError);
  EXPECT_THROW(PlaneDevice("no such device"), Error);
}

}  // namespace
}  // namespace steradian::plane::plane_device_test
