// frame/lights/...: pictures under many lights, summed as `--lights auto` does; with the suffix /all one by one.
//
//   frame/lights/N               a diffuse floor under N quads at 320 x 180
//   frame/lights/hall/N          a diffuse hall of 40 x 10 x 60 m with N small rectangles below its ceiling, on its walls and above its
//                                floor, at 1080p
//   frame/lights/balls/N         the same with 24 balls in it
//   frame/lights/near/H/N        the hall's floor under N rectangles that face it from H metres above
//   frame/lights/METHOD/N        the hall of a metal of roughness 0.4
// frame/lights/shadowed/N      the hall with shadows, at 480 x 270; nothing occludes its lights
//
// On a Vulkan device lights are summed one by one, under vulkan/frame/...
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "benches.h"
#include "floor.h"
#include "frame.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::bench {
namespace {

constexpr int kManyLightsWidth = 1920, kManyLightsHeight = 1080;

// Quads of one size on a grid above the whole floor, whatever their number.
std::vector<AreaLight> ceiling(int count) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  const double step = 2.0 * kFloorHalf / side;
  std::vector<AreaLight> lights;
  for (int i = 0; i < count; ++i)
    lights.push_back(ceiling_quad((i % side + 0.5) * step - kFloorHalf, (i / side + 0.5) * step - kFloorHalf, 0.2));
  return lights;
}

// A random light of the hall: 70 of 100 near the ceiling, tilted up to 29 degrees, 20 on walls, 10 lamps of any direction.
AreaLight hall_light(std::mt19937& random, double size) {
  // std::uniform_real_distribution is avoided, because its numbers depend on the library.
  const auto uniform = [&](double low, double high) { return low + (high - low) * (static_cast<double>(random()) / 4294967296.0); };
  const double kind = uniform(0, 1), z = uniform(-30, 30), a = size * uniform(0.5, 1.5), b = size * uniform(0.5, 1.5);
  Vec3d center{uniform(-20, 20), uniform(9, 9.9), z}, normal{uniform(-0.4, 0.4), -1, uniform(-0.4, 0.4)};
  if (kind >= 0.9) {
    center.y = uniform(0.4, 2);
    normal = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  } else if (kind >= 0.7) {
    const double side = kind < 0.8 ? -1 : 1;
    center = {19.9 * side, uniform(1, 9), z};
    normal = {-side, uniform(-0.3, 0.3), uniform(-0.3, 0.3)};
  }
  const steradian::Frame frame = steradian::Frame::from_normal(normalized(normal));
  const Vec3d x = frame.x * a, y = frame.y * b;
  AreaLight light;
  light.shape = Polygon{{center - x - y, center + x - y, center + x + y, center - x + y}, {}};
  light.radiance = {uniform(0.3, 1), uniform(0.3, 1), uniform(0.3, 1)};
  return light;
}

Mesh wall(Vec3f a, Vec3f b, Vec3f c, Vec3f d) { return scene::quad_mesh(a, b, c, d, 0); }

// The hall without lights.
Scene empty_hall() {
  Scene scene;
  scene.materials = {diffuse()};
  scene.meshes = {
      wall({-20, 0, 30}, {20, 0, 30}, {20, 0, -30}, {-20, 0, -30}), wall({-20, 10, -30}, {20, 10, -30}, {20, 10, 30}, {-20, 10, 30}),
      wall({-20, 0, 30}, {-20, 0, -30}, {-20, 10, -30}, {-20, 10, 30}), wall({20, 0, -30}, {20, 0, 30}, {20, 10, 30}, {20, 10, -30}),
      wall({-20, 0, -30}, {20, 0, -30}, {20, 10, -30}, {-20, 10, -30})};
  Camera camera;
  camera.position = {0, 1.7, 29};
  camera.yfov = 0.9;
  scene.cameras = {camera};
  return scene;
}

Scene hall(int count) {
  Scene scene = empty_hall();
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) scene.area_lights.push_back(hall_light(random, 0.25 * std::sqrt(1000.0 / count)));
  return scene;
}

Scene hall_with_balls(int count) {
  Scene scene = hall(count);
  for (int i = 0; i < 24; ++i)
    scene.meshes.push_back(scene::ball_mesh(static_cast<Vec3f>(Vec3d{-15.0 + 6 * (i % 6), 1.2 + 1.5 * (i / 6 % 2), 18.0 - 10 * (i / 6)}),
                                            1.0f + 0.1f * static_cast<float>(i % 5), 0, 48, 24));
  return scene;
}

// Lights on a grid over the whole floor.
Scene hall_lit_from(double height, int count) {
  Scene scene = empty_hall();
  const int across = static_cast<int>(std::ceil(std::sqrt(count / 1.5))), along = (count + across - 1) / across;
  for (int i = 0; i < count; ++i) {
    const Vec3d c{-20 + 40 * (i % across + 0.5) / across, height, -30 + 60 * (i / across + 0.5) / along}, x{0.25, 0, 0}, z{0, 0, 0.25};
    AreaLight light;
    light.shape = Polygon{{c - x - z, c + x - z, c + x + z, c - x + z}, {}};
    light.radiance = {1, 0.8, 0.6};
    scene.area_lights.push_back(light);
  }
  return scene;
}

// The lights keep clear of the ceiling and the walls.
Scene hall_with_room(int count) {
  Scene scene = hall(count);
  scene.area_lights.clear();
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) {
    AreaLight light = hall_light(random, 0.25 * std::sqrt(1000.0 / count));
    auto& corners = std::get<Polygon>(light.shape).vertices;
    const Vec3d middle = (corners[0] + corners[2]) * 0.5, moved = {middle.x * 0.95, middle.y * 0.85 + 0.5, middle.z * 0.97};
    for (Vec3d& v : corners) v = v + moved - middle;
    scene.area_lights.push_back(light);
  }
  return scene;
}

}  // namespace

void add_many_lights(BenchList& list, const Where& where) {
  const bool on_cpu = where.backend == Backend::cpu;
  const std::string prefix = on_cpu ? "frame/lights/" : "vulkan/frame/lights/";
  // most: the largest count that is summed one by one, which takes up to a minute per frame.
  const auto add = [&](const std::string& what, int count, int most, auto scene, auto change) {
    const std::pair<const char*, LightSum> sums[] = {{"", LightSum::automatic}, {"/all", LightSum::all}};
    for (const auto& [suffix, sum] : sums) {
      if ((!on_cpu && sum != LightSum::all) || (sum == LightSum::all && count > most)) continue;
      const std::string name = prefix + what + std::to_string(count) + suffix;
      list.add(name, [=, sum = sum](const BenchOptions&) {
        auto frame = frame_on(where, 1);
        frame->scene = scene(count);
        frame->options.width = kManyLightsWidth;
        frame->options.height = kManyLightsHeight;
        frame->options.method = "exact";
        frame->options.lights = sum;
        change(*frame);
        Bench bench = bench_of(name, frame);
        bench.once = count >= 1000 && sum == LightSum::all;
        return bench;
      });
    }
  };
  const auto as_it_is = [](BenchFrame&) {};
  const auto small = [](BenchFrame& frame) {
    frame.options.width = 320;
    frame.options.height = 180;
  };
  const auto floor = [](int count) {
    Scene scene = floor_scene();
    scene.materials[0] = diffuse();
    scene.area_lights = ceiling(count);
    return scene;
  };
  for (const int count : {1, 10, 16, 64, 100, 1000, 10000}) add("", count, 10000, floor, small);
  for (const int count : {100, 1000, 10000, 100000}) add("hall/", count, 1000, hall, as_it_is);
  add("balls/", 1000, 1000, hall_with_balls, as_it_is);
  for (const char* height : {"3", "1", "0.3", "0.1"})
    add(
        std::string("near/") + height + "/", 1000, 1000, [=](int count) { return hall_lit_from(std::stod(height), count); }, as_it_is);
  for (const std::string method : {"ltc", "closed-form"})
    add(method + "/", 1000, 1000, hall, [=](BenchFrame& frame) {
      frame.options.method = method;
      frame.scene.materials[0].metallic = 1;
      frame.scene.materials[0].roughness = 0.4f;
      frame.options.width = 640;
      frame.options.height = 360;
    });
  if (on_cpu)
    for (const int count : {100, 1000})
      add("shadowed/", count, 0, hall_with_room, [](BenchFrame& frame) {
        frame.options.shadows = Shadows::on;
        frame.options.width = 480;
        frame.options.height = 270;
      });
}

}  // namespace steradian::bench
