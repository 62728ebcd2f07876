// frame/...: whole pictures, with the time of every pass.
//
//   frame/direct/METHOD/1080p   a floor that fills the picture under one quad light; diffuse for `exact`, with a GGX lobe
//                               on top for the others. The lighting is the passes `direct` and `specular`.
//   frame/rays/arcade/1080p     primary rays of the colonnade alone
//   frame/lights/N              a diffuse floor under N quad lights at 320 x 180
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "benches.h"
#include "frame.h"
#include "core/float_mode.h"
#include "render/cpu/gbuffer.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"

namespace steradian::bench {
namespace {

constexpr int kWidth = 1920, kHeight = 1080;
constexpr double kHalf = 8;  // of the floor's side [m]

// A floor seen at an angle; it covers the whole picture.
Scene floor_scene() {
  Scene scene;
  scene.materials.resize(1);
  Mesh mesh;
  constexpr auto kEnd = static_cast<float>(kHalf);
  mesh.positions = {{-kEnd, 0, kEnd}, {kEnd, 0, kEnd}, {kEnd, 0, -kEnd}, {-kEnd, 0, -kEnd}};
  mesh.normals.assign(4, {0, 1, 0});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes = {mesh};
  Camera camera;
  camera.position = {0, 3, 4};
  camera.z = normalized(Vec3d{0, 3, 4});
  camera.y = cross(camera.z, camera.x);
  camera.yfov = 0.6;
  scene.cameras = {camera};
  return scene;
}

SurfaceMaterial diffuse() {
  SurfaceMaterial m;
  m.base_color = {0.5f, 0.5f, 0.5f, 1};
  m.metallic = 0;
  m.specular = 0;
  return m;
}

SurfaceMaterial glossy() {
  SurfaceMaterial m = diffuse();
  m.specular = 1;
  m.roughness = 0.4f;
  return m;
}

AreaLight ceiling_quad(double x, double z, double half) {
  AreaLight light;
  light.shape = Polygon{{{x - half, 1.5, z - half}, {x + half, 1.5, z - half}, {x + half, 1.5, z + half}, {x - half, 1.5, z + half}}, {}};
  light.radiance = {1, 1, 1};
  return light;
}

// Quads of one size on a grid above the whole floor, whatever their number.
std::vector<AreaLight> ceiling(int count) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  const double step = 2.0 * kHalf / side;
  std::vector<AreaLight> lights;
  for (int i = 0; i < count; ++i) lights.push_back(ceiling_quad((i % side + 0.5) * step - kHalf, (i / side + 0.5) * step - kHalf, 0.2));
  return lights;
}

Bench direct(const std::string& name, const std::string& method, int threads) {
  auto frame = std::make_shared<Frame>();
  frame->scene = floor_scene();
  frame->scene.materials[0] = method == "exact" ? diffuse() : glossy();
  frame->scene.area_lights = {ceiling_quad(0, 0, 0.5)};
  frame->options.width = kWidth;
  frame->options.height = kHeight;
  frame->options.method = method;
  frame->options.threads = threads;
  return bench_of(name, frame);
}

Bench lights(const std::string& name, int count) {
  auto frame = std::make_shared<Frame>();
  frame->scene = floor_scene();
  frame->scene.materials[0] = diffuse();
  frame->scene.area_lights = ceiling(count);
  frame->options.width = 320;
  frame->options.height = 180;
  frame->options.method = "exact";
  frame->options.threads = 1;
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

void add_frame(BenchList& list) {
  for (const std::string method : {"exact", "ltc-compact", "ltc", "closed-form"})
    add(list, "frame/direct/" + method + "/1080p", [=](const std::string& name, int threads) { return direct(name, method, threads); });
  if (std::filesystem::exists(arcade())) add(list, "frame/rays/arcade/1080p", rays);
  for (const int count : {1, 10, 100, 1000}) {
    const std::string name = "frame/lights/" + std::to_string(count);
    list.add(name, [=](const BenchOptions&) { return lights(name, count); });
  }
}

}  // namespace steradian::bench
