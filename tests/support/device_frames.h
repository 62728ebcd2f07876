// The CPU is the reference for the device: scenes and comparisons that tests of whole frames share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "device/frame/frame.h"
#include "device/vulkan/device.h"
#include "night.h"
#include "paths.h"
#include "steradian/load_scene.h"
#include "support/meshes.h"

namespace steradian::vulkan {

inline Scene scene_of(const std::string& name) { return load_scene(test::kSourceDir + "/scenes/" + name + ".glb").scene; }

inline RenderOptions small(const std::string& method) {
  RenderOptions options;
  options.width = test::by_day_or_night(96, 160);
  options.height = test::by_day_or_night(54, 90);
  options.method = method;
  return options;
}

// Prints the error, and where it is largest. The bound is the back end's promise (docs/vulkan.md): float's own error along an outline is a
// hundredth of it. outliers: number of pixels whose error may exceed a thousandth of the picture's mean. There, a rounding changes how
// many nodes or corners represent a light. The bound is that of the others. Returns RenderStats::shadow_on_host.
inline double expect_same(const std::string& name, const Scene& scene, RenderOptions options, int outliers = 0) {
  options.backend = Backend::cpu;
  const Picture cpu = render(scene, options);
  options.backend = Backend::vulkan;
  RenderStats stats;
  const Picture device = render(scene, options, &stats);
  const auto square = [](Vec3f v) { return static_cast<double>(dot(v, v)); };
  double squares = 0;
  for (const Vec3f& p : cpu.pixels) squares += square(p);
  const double limit = 1e-6 * squares / static_cast<double>(cpu.pixels.size());
  double errors = 0, of_others = 0, largest = 0;
  int found = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < cpu.pixels.size(); ++i) {
    const double error = square(device.pixels[i] - cpu.pixels[i]);
    if (!std::isfinite(error)) {
      ADD_FAILURE() << name << " pixel " << i;
      return 1;
    }
    errors += error;
    if (error > limit)
      ++found;
    else
      of_others += error;
    if (error > largest) {
      largest = error;
      x = static_cast<int>(i) % options.width;
      y = static_cast<int>(i) / options.width;
    }
  }
  std::printf("%-16s %-22s relative L2 %.1e, largest %.1e at (%d, %d), %d pixels off by 0.1 %% of the mean, %.1e without them\n",
              name.c_str(), options.method.c_str(), std::sqrt(errors / squares), std::sqrt(largest), x, y, found,
              std::sqrt(of_others / squares));
  EXPECT_LE(found, outliers) << name << " by " << options.method;
  EXPECT_LE(std::sqrt(of_others / squares), 1e-4) << name << " by " << options.method;
  return stats.shadow_on_host;
}

inline AreaLight light_of(Shape shape, Vec3d radiance, bool two_sided = false) {
  AreaLight light;
  light.shape = std::move(shape);
  light.radiance = radiance;
  light.two_sided = two_sided;
  return light;
}

inline PunctualLight punctual(PunctualKind kind, Vec3d position, Vec3d direction) {
  PunctualLight light;
  light.kind = kind;
  light.position = position;
  light.direction = normalized(direction);
  light.intensity = {1.5, 1, 0.5};
  return light;
}

inline const Polygon kSquare{{{-1, 2.5, -1}, {1, 2.5, -1}, {1, 2.5, 1}, {-1, 2.5, 1}}, {}};

// Arrangement of triangles about an axis: over a disk, with this size, at this height and up to `slope` above or below it.
struct Spread {
  double radius = 0.6, size = 0.1, height = 1.5, slope = 0.1;
};
// With up to 250 triangles, none overlaps another one from any viewpoint. From the whole floor, each is seen entirely in front of kSquare.
inline constexpr Spread kFlatBeforeSquare{0.75, 0.03, 2.4, 0};

// A floor under a light, with scattered triangles in between.
inline Scene under_triangles(int count, const Shape& light = kSquare, const Spread& spread = {}) {
  Scene scene;
  SurfaceMaterial floor;
  floor.metallic = 0.3f;
  floor.roughness = 0.4f;
  floor.clearcoat = 0.5f;
  floor.clearcoat_roughness = 0.2f;
  floor.sheen_color = {0.2f, 0.3f, 0.1f};
  scene.materials = {floor};
  scene.meshes = {scene::quad_mesh({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, 0), Mesh{}};
  Mesh& triangles = scene.meshes[1];
  for (int i = 0; i < count; ++i) {
    const double turn = 2.399963 * i, away = spread.radius * std::sqrt((i + 0.5) / count);  // like the seeds of a sunflower
    for (int corner = 0; corner < 3; ++corner) {
      const double angle = turn + 2.1 * corner;
      triangles.indices.push_back(static_cast<std::uint32_t>(triangles.positions.size()));
      triangles.positions.push_back({static_cast<float>(away * std::cos(turn) + spread.size * std::cos(angle)),
                                     static_cast<float>(spread.height + spread.slope * std::sin(3 * angle)),
                                     static_cast<float>(away * std::sin(turn) + spread.size * std::sin(angle))});
      triangles.normals.push_back({0, 1, 0});
    }
  }
  Camera camera;
  camera.position = {0, 2.5, 5};
  camera.z = normalized(Vec3d{0, 0.4, 1});
  camera.y = {0, camera.z.z, -camera.z.y};
  scene.cameras = {camera};
  scene.area_lights = {light_of(light, {3, 2, 1}, true)};
  return scene;
}

inline std::vector<std::string> warnings_of(const Scene& scene, RenderOptions options) {
  options.width = options.height = 32;
  RenderStats stats;
  DeviceFrame(scene, options).render(&stats);
  return stats.warnings;
}

// The CPU renders the picture, with one warning that has these words.
inline void expect_rendered_by_cpu(const Scene& scene, RenderOptions options, const std::string& words) {
  options.width = 48;
  options.height = 27;
  const Picture cpu = render(scene, options);
  options.backend = Backend::vulkan;
  RenderStats stats;
  const Picture picture = render(scene, options, &stats);
  EXPECT_TRUE(picture.pixels == cpu.pixels) << words;
  EXPECT_EQ(std::count_if(stats.warnings.begin(), stats.warnings.end(),
                          [&](const std::string& w) {
                            return w.find("the CPU renders this picture") != std::string::npos && w.find(words) != std::string::npos;
                          }),
            1)
      << words << ": " << (stats.warnings.empty() ? "no warning" : stats.warnings.back());
}

class VulkanFrame : public testing::Test {
 protected:
  void SetUp() override {
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  }
};

}  // namespace steradian::vulkan
