// frame/...: whole pictures, with the time of every pass.
//
//   frame/direct/METHOD/1080p   a floor that fills the picture under one quad light; diffuse for `exact`, with a GGX lobe
//                               on top for the others. The lighting is the passes `direct` and `specular`.
//   frame/gallery/METHOD/720p   the gallery's direct light without shadows
//   frame/rays/arcade/1080p     primary rays of the colonnade alone
//   frame/lights/N              a diffuse floor under N quad lights at 320 x 180, added up as `--lights auto` does
//   frame/lights/N/all          the same one by one
//   frame/lights/hall/N         a diffuse hall of 40 x 10 x 60 m with N small lights below its ceiling, on its walls and above its floor,
//                               at 1080p; /all: one by one
//
// On a Vulkan device the same, but for the rays and the lights added up together, under vulkan/frame/...
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "benches.h"
#include "floor.h"
#include "frame.h"
#include "core/float_mode.h"
#include "render/cpu/gbuffer.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"

namespace steradian::bench {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;

// Quads of one size on a grid above the whole floor, whatever their number.
std::vector<AreaLight> ceiling(int count) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  const double step = 2.0 * kFloorHalf / side;
  std::vector<AreaLight> lights;
  for (int i = 0; i < count; ++i)
    lights.push_back(ceiling_quad((i % side + 0.5) * step - kFloorHalf, (i / side + 0.5) * step - kFloorHalf, 0.2));
  return lights;
}

std::shared_ptr<Frame> frame_on(const Where& where, int threads) {
  auto frame = std::make_shared<Frame>();
  frame->options.backend = where.backend;
  frame->options.device = where.device;
  frame->options.threads = threads;
  return frame;
}

Bench direct(const Where& where, const std::string& name, const std::string& method, int threads) {
  auto frame = frame_on(where, threads);
  frame->scene = floor_scene();
  frame->scene.materials[0] = method == "exact" ? diffuse() : glossy();
  frame->scene.area_lights = {ceiling_quad(0, 0, 0.5)};
  frame->options.width = kWidth;
  frame->options.height = kHeight;
  frame->options.method = method;
  return bench_of(name, frame);
}

// What the hall is lit by: 70 of 100 near the ceiling, tilted up to 29 degrees, 20 on walls, 10 lamps of any direction.
AreaLight hall_light(std::mt19937& random, double size) {
  // Not std::uniform_real_distribution, whose numbers are the library's choice.
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

Mesh wall(Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
  Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.normals.assign(4, normalized(cross(b - a, d - a)));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Scene hall(int count) {
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
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) scene.area_lights.push_back(hall_light(random, 0.25 * std::sqrt(1000.0 / count)));
  return scene;
}

Bench hall_lights(const Where& where, const std::string& name, int count, LightSum sum) {
  auto frame = frame_on(where, 1);
  frame->scene = hall(count);
  frame->options.width = kWidth;
  frame->options.height = kHeight;
  frame->options.method = "exact";
  frame->options.lights = sum;
  return bench_of(name, frame);
}

std::string gallery_file() { return std::string(STERADIAN_SCENES) + "/gallery.glb"; }

Bench gallery(const Where& where, const std::string& name, const std::string& method, int threads) {
  auto frame = frame_on(where, threads);
  frame->scene = load_scene(gallery_file()).scene;
  frame->options.method = method;
  return bench_of(name, frame);
}

Bench lights(const Where& where, const std::string& name, int count, LightSum sum) {
  auto frame = frame_on(where, 1);
  frame->scene = floor_scene();
  frame->scene.materials[0] = diffuse();
  frame->scene.area_lights = ceiling(count);
  frame->options.lights = sum;
  frame->options.width = 320;
  frame->options.height = 180;
  frame->options.method = "exact";
  return bench_of(name, frame);
}

struct Rays {
  Scene scene;
  RayScene rays;
  CameraRays camera;
  tbb::task_arena arena;

  Rays(Scene s, int threads) : scene(std::move(s)), rays(scene), camera(scene.cameras.at(0), kWidth, kHeight), arena(threads) {}
  void call() {
    constexpr int kAcross = (kWidth + kTileSide - 1) / kTileSide, kDown = (kHeight + kTileSide - 1) / kTileSide;
    arena.execute([&] {
      tbb::parallel_for(0, kAcross * kDown, [&](int i) {
        const FlushDenormals flush;
        const int x = i % kAcross * kTileSide, y = i / kAcross * kTileSide;
        TileHits hits;
        trace_tile(rays, camera, {x, y, std::min(kTileSide, kWidth - x), std::min(kTileSide, kHeight - y)}, pixel_place(0, 1), hits);
        keep(hits.u);
      });
    });
  }
};

// Made by the build, beside the program's folder.
std::filesystem::path arcade() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "scenes" / "arcade.glb";
}

Bench rays(const std::string& name, int threads) {
  auto work = std::make_shared<Rays>(load_scene(arcade().string()).scene, threads);
  return {name, std::size_t{kWidth} * kHeight, "", [work] { work->call(); }, false, {}};
}

// One thread, and two under a name of its own.
void add(BenchList& list, const std::string& name, const std::function<Bench(const std::string&, int)>& make) {
  for (const int threads : {1, 2}) {
    const std::string one = threads == 1 ? name : name + "/threads=" + std::to_string(threads);
    list.add(one, [=](const BenchOptions&) { return make(one, threads); });
  }
}

}  // namespace

void add_frame(BenchList& list, const Where& where) {
  const bool on_cpu = where.backend == Backend::cpu;
  const std::string prefix = on_cpu ? "frame/" : "vulkan/frame/";
  // A device has threads of its own: one name, and all of the host's.
  const auto add_by = [&](const std::string& name, auto make) {
    if (on_cpu)
      add(list, prefix + name, make);
    else
      list.add(prefix + name, [=](const BenchOptions&) { return make(prefix + name, 0); });
  };
  for (const std::string method : {"exact", "ltc-compact", "ltc", "closed-form"})
    add_by("direct/" + method + "/1080p", [=](const std::string& name, int threads) { return direct(where, name, method, threads); });
  if (std::filesystem::exists(gallery_file()))
    for (const std::string method : {"ltc-compact", "ltc", "closed-form"})
      add_by("gallery/" + method + "/720p", [=](const std::string& name, int threads) { return gallery(where, name, method, threads); });
  if (on_cpu && std::filesystem::exists(arcade())) add(list, "frame/rays/arcade/1080p", rays);
  const std::pair<const char*, LightSum> sums[] = {{"", LightSum::automatic}, {"/all", LightSum::all}};
  for (const int count : {1, 10, 16, 64, 100, 1000, 10000})
    for (const auto& [suffix, sum] : sums) {
      if (!on_cpu && sum != LightSum::all) continue;
      const std::string name = prefix + "lights/" + std::to_string(count) + suffix;
      list.add(name, [=, sum = sum](const BenchOptions&) { return lights(where, name, count, sum); });
    }
  for (const int count : {100, 1000, 10000, 100000})
    for (const auto& [suffix, sum] : sums) {
      if (!on_cpu && sum != LightSum::all) continue;
      if (count > 1000 && sum == LightSum::all) continue;  // a minute a frame
      const std::string name = prefix + "lights/hall/" + std::to_string(count) + suffix;
      list.add(name, [=, sum = sum](const BenchOptions&) {
        Bench bench = hall_lights(where, name, count, sum);
        bench.once = count == 1000 && sum == LightSum::all;
        return bench;
      });
    }
}

}  // namespace steradian::bench
