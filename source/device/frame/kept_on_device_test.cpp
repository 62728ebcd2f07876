// Objects that stay on a device from picture to picture: they serve the next picture, and never show in it.
#include "device/frame/kept_on_device.h"

#include <chrono>
#include <cmath>
#include <memory>

#include "device/vulkan/handles.h"
#include "render/surface/ray_scene.h"
#include "support/device_frames.h"
#include "support/memory.h"

namespace steradian::vulkan::kept_on_device_test {
namespace {

// Pictures with one cache, each compared with one rendered without it, on the same device.
struct Pictures {
  std::shared_ptr<const Device> device;
  Scene scene;
  RenderOptions options;
  SurfacesBy surfaces = SurfacesBy::host;
  RaysBy rays = RaysBy::host;
  RenderCache cache{};

  Picture next() { return DeviceFrame(scene, options, device, surfaces, rays, &cache).render(); }
  // Returns the number of memory allocations on the device.
  std::size_t render(const std::string& what) {
    const std::size_t before = device->allocations();
    const Picture picture = next();
    const std::size_t asked = device->allocations() - before;
    std::printf("%s: %zu allocations\n", what.c_str(), asked);
    EXPECT_EQ(picture.pixels, DeviceFrame(scene, options, device, surfaces, rays).render().pixels) << what;
    return asked;
  }
  KeptOnDevice& kept() { return *cache.parts().on_device.first; }

  void move_camera() {
    Vec3d& position = scene.cameras.front().position;
    position = position + Vec3d{0.07, 0.03, -0.05};
  }
  // Moves a polygon with the triangles that show it, or a point if there is none.
  void move_lamp() {
    const Vec3d by{0.05, 0.02, -0.03};
    for (std::size_t i = 0; i < scene.area_lights.size(); ++i) {
      auto* polygon = std::get_if<Polygon>(&scene.area_lights[i].shape);
      if (polygon == nullptr) continue;
      for (Vec3d& vertex : polygon->vertices) vertex = vertex + by;
      for (Mesh& mesh : scene.meshes)
        if (!mesh.triangle_lights.empty() && mesh.triangle_lights.front() == static_cast<std::int32_t>(i))
          for (Vec3f& position : mesh.positions) position = position + static_cast<Vec3f>(by);
      return;
    }
    Vec3d& position = scene.punctual_lights.at(0).position;
    position = position + by;
  }
};

RenderOptions tiny(const std::string& method, steradian::Shadows shadows) {
  RenderOptions options = small(method);
  options.width = 80;
  options.height = 45;
  options.shadows = shadows;
  return options;
}

void expect_nothing_asked_for(Pictures pictures) {
  EXPECT_GT(pictures.render("the first picture"), 0u);
  EXPECT_EQ(pictures.render("the same again"), 0u);
  pictures.move_camera();
  EXPECT_EQ(pictures.render("the camera moved"), 0u);
  pictures.move_lamp();
  EXPECT_EQ(pictures.render("a lamp moved"), 0u);
}

// One device for all tests, since its pipelines take longer to create than pictures.
class KeptOnVulkan : public VulkanFrame {
 protected:
  static void TearDownTestSuite() { shared.reset(); }
  static std::shared_ptr<const Device> device() {
    if (shared == nullptr) shared = std::make_shared<const Device>();
    return shared;
  }
  static inline std::shared_ptr<const Device> shared;
};

}  // namespace

TEST_F(KeptOnVulkan, AMovedCameraOrLampAsksForNoMemory) {
  expect_nothing_asked_for({device(), scene_of("gallery"), tiny("ltc-compact", steradian::Shadows::off)});
}

TEST_F(KeptOnVulkan, NorDoTheirShadows) {
  expect_nothing_asked_for({device(), scene_of("room"), tiny("ltc-compact", steradian::Shadows::on), SurfacesBy::host, RaysBy::device});
}

// A lamp goes to and fro above occluders.
TEST_F(KeptOnVulkan, AFilmOfTwoHundredFramesAsksForNoMemoryAfterTheSecond) {
  Pictures p{device(), under_triangles(12), tiny("ltc-compact", steradian::Shadows::on)};
  p.options.width = 32;
  p.options.height = 18;
  const std::vector<Vec3d> vertices = std::get<Polygon>(p.scene.area_lights[0].shape).vertices;
  std::size_t allocations = 0, submissions = 0;
  for (int frame = 0; frame < 200; ++frame) {
    if (frame == 2) allocations = p.device->allocations(), submissions = p.device->submissions();
    const Vec3d by{0.5 * std::sin(0.1 * frame), 0.1 * std::sin(0.23 * frame), 0.5 * std::sin(0.17 * frame)};
    for (std::size_t i = 0; i < vertices.size(); ++i) std::get<Polygon>(p.scene.area_lights[0].shape).vertices[i] = vertices[i] + by;
    p.next();
  }
  EXPECT_EQ(p.device->allocations(), allocations);
  EXPECT_EQ(p.device->submissions() - submissions, 198u);
}

TEST_F(KeptOnVulkan, NorDoSurfacesByRaster) {
  expect_nothing_asked_for({device(), scene_of("textured_floor"), tiny("ltc-compact", steradian::Shadows::off), SurfacesBy::device});
}

TEST_F(KeptOnVulkan, NorDoesTheBounce) {
  RenderOptions options = tiny("ltc-compact", steradian::Shadows::off);
  options.indirect.mode = IndirectMode::ltc;
  options.indirect.virtual_lights = 1024;
  expect_nothing_asked_for({device(), scene_of("ring"), options});
}

// Buffers hold data of an earlier picture, and pictures must have the same bytes.
TEST_F(KeptOnVulkan, NothingOfAnotherSceneSizeOrMethodShows) {
  for (const SurfacesBy surfaces : {SurfacesBy::host, SurfacesBy::device}) {
    Pictures p{device(), scene_of("textured_floor"), tiny("ltc-compact", steradian::Shadows::off), surfaces};
    p.render("a scene");
    p.options.width = 130;
    EXPECT_EQ(p.render("a wider picture") > 0, surfaces == SurfacesBy::device);
    p.options.width = 70;
    p.options.height = 90;
    p.render("a higher one");
    p.options.method = "ltc";
    p.render("another table");
    SurfaceMaterial& material = p.scene.materials.front();
    material.base_color = {0.2f, 0.3f, 0.9f, 1};
    material.roughness = 0.35f;
    p.render("another material");
    ASSERT_FALSE(p.scene.images.empty());
    for (Image& image : p.scene.images)
      for (std::size_t i = 0; i < image.rgba.size(); i += 4) std::swap(image.rgba[i], image.rgba[i + 2]);
    p.render("other texels");
    p.scene = scene_of("gallery");
    p.render("another scene");
    p.options.shadows = steradian::Shadows::on;
    p.options.width = p.options.height = 40;
    p.rays = RaysBy::device;
    p.render("its shadows");
    Mesh* blocker = nullptr;
    for (Mesh& mesh : p.scene.meshes)
      if (!mesh.is_light_shape && !mesh.is_emitter() && mesh.triangle_count() > 50) blocker = &mesh;
    ASSERT_NE(blocker, nullptr);
    for (Vec3f& position : blocker->positions) position = position + Vec3f{0.1f, 0.2f, 0};
    p.render("a mesh moved");
    p.scene = scene_of("textured_floor");
    p.options.shadows = steradian::Shadows::off;  // the device has none under textured lights
    p.render("the first scene again");
  }
}

// Data that depend on the scene alone are written when the scene changes, tables never. A mark outside any picture stays.
TEST_F(KeptOnVulkan, WhatHasNotChangedIsNotWrittenAgain) {
  Pictures p{device(), scene_of("textured_floor"), tiny("ltc-compact", steradian::Shadows::off), SurfacesBy::device};
  p.render("the first picture");
  struct Part {
    const char* name;
    const Buffer& buffer;
    bool changes;  // when a lamp moves, with the mesh that shows it
  };
  const SceneBuffers& scene = p.kept().raster->scene;
  const Part parts[] = {{"tables", p.kept().direct.tables.get(), false},
                        {"vertices", scene.vertices(), true},
                        {"triangles", scene.triangles(), false},
                        {"materials", scene.materials(), false},
                        {"texels", scene.texels(), false}};
  const auto mark = [](const Buffer& buffer) -> char& { return static_cast<char*>(buffer.mapped())[0]; };
  for (const bool lamp : {false, true}) {
    std::vector<char> marks;
    for (const Part& part : parts) marks.push_back(static_cast<char>(mark(part.buffer) ^= 1));
    lamp ? p.move_lamp() : p.move_camera();
    p.next();
    for (std::size_t i = 0; i < marks.size(); ++i) {
      EXPECT_EQ(mark(parts[i].buffer) != marks[i], lamp && parts[i].changes) << parts[i].name;
      if (mark(parts[i].buffer) == marks[i]) mark(parts[i].buffer) ^= 1;
    }
  }
}

// Objects made for a picture are released with it.
TEST_F(KeptOnVulkan, PicturesLeaveMemoryWhereItWas) {
  Pictures p{device(), scene_of("glossy_floor"), tiny("ltc-compact", steradian::Shadows::on), SurfacesBy::device};
  p.options.width = p.options.height = 8;
  const auto render = [&](int count) {
    for (int i = 0; i < count; ++i) {
      Vec3d& position = p.scene.cameras.front().position;
      position.x += i % 2 == 0 ? 0.05 : -0.05;
      p.next();
    }
  };
  render(30);
  const double before = test::resident_mib();
  render(200);
  const double after = test::resident_mib();
  std::printf("resident: %.1f MiB after 30 pictures, %.1f MiB after 230\n", before, after);
  EXPECT_LE(after, before + 2);
}

TEST_F(KeptOnVulkan, TheValidationLayerFindsNothing) {
  const auto validated = std::make_shared<const Device>(DeviceOptions{"", true});
  for (const SurfacesBy surfaces : {SurfacesBy::host, SurfacesBy::device}) {
    Pictures p{validated, scene_of("textured_floor"), tiny("ltc-compact", steradian::Shadows::off), surfaces, RaysBy::device};
    for (const auto& [width, height] : {std::pair{48, 27}, {20, 64}, {48, 27}}) {
      p.options.width = width;
      p.options.height = height;
      p.next();
    }
    p.scene = scene_of("gallery");
    p.options.shadows = steradian::Shadows::on;
    p.next();
  }
  EXPECT_TRUE(validated->validation_messages().empty())
      << validated->validation_messages().size() << " messages, the first: " << validated->validation_messages().front();
}

// Pipelines take longer to create than pictures: a cache holds the device that has them until there is an error.
TEST_F(KeptOnVulkan, ACacheKeepsTheDeviceAndItsPipelines) {
  Scene scene = scene_of("gallery");
  RenderOptions options = tiny("ltc-compact", steradian::Shadows::off);
  options.backend = Backend::vulkan;
  RenderCache cache;
  const auto count = [&] {
    std::size_t made = 0;
    for (const auto& [key, pipelines] : cache.parts().on_device.first->device->handles().pipelines) made += pipelines.made.size();
    return made;
  };
  using Clock = std::chrono::steady_clock;
  const auto timed = [&](const char* what, auto make) {
    const auto start = Clock::now();
    Picture picture = make();
    std::printf("%s: %.0f ms\n", what, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    return picture;
  };
  timed("the first picture", [&] { return render(scene, options, cache); });
  const std::size_t pipelines = count();
  const KeptOnDevice* kept = cache.parts().on_device.first.get();
  EXPECT_GT(pipelines, 0u);
  EXPECT_EQ(timed("the same again", [&] { return render(scene, options, cache); }).pixels, render(scene, options).pixels);
  EXPECT_EQ(count(), pipelines);
  for (AreaLight& light : scene.area_lights)
    if (auto* polygon = std::get_if<Polygon>(&light.shape))
      for (Vec3d& vertex : polygon->vertices) vertex = vertex + Vec3d{0.01, 0, 0};
  const Picture moved = timed("a lamp moved", [&] { return render(scene, options, cache); });
  EXPECT_EQ(moved.pixels, timed("without a cache", [&] { return render(scene, options); }).pixels);
  EXPECT_EQ(cache.parts().on_device.first.get(), kept);
  options.device = "no such device";
  EXPECT_THROW(render(scene, options, cache), Error);
  EXPECT_EQ(cache.parts().on_device.first, nullptr);
}

}  // namespace steradian::vulkan::kept_on_device_test
