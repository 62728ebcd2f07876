// frame/...: whole pictures, with the time of every pass.
//
// frame/direct/METHOD/1080p   a floor that fills the picture under one quad light; diffuse for `exact`, with a GGX lobe
//                            on top for the others. The lighting is the passes `direct` and `specular`.
// frame/disk/EMISSION/720p    a spot of 0.2 m over a glossy floor with a board in its light: `even`, or `profiled` by a cone of 45 degrees
// frame/gallery/METHOD/720p   the gallery's direct light without shadows
// frame/moved/METHOD/SIZE     the same after its polygons have moved, with the contents of RenderCache, including all preparation
// frame/dragged/cornell/SIZE  the window's preview of all light after the lamp of the box has moved, from the file's JSON on
// frame/rays/arcade/1080p     primary rays of the colonnade alone
//
// On a Vulkan device the same benches except the rays run under vulkan/frame/...
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "benches.h"
#include "core/float_mode.h"
#include "floor.h"
#include "frame.h"
#include "render/surface/gbuffer.h"
#include "scene/gltf/gltf_file.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "steradian/render_cache.h"

namespace steradian::bench {
namespace {

constexpr int kFrameWidth = 1920, kFrameHeight = 1080;

Bench direct(const Where& where, const std::string& name, const std::string& method, int threads) {
  auto frame = frame_on(where, threads);
  frame->scene = floor_scene();
  frame->scene.materials[0] = method == "exact" ? diffuse() : glossy();
  frame->scene.area_lights = {ceiling_quad(0, 0, 0.5)};
  frame->options.width = kFrameWidth;
  frame->options.height = kFrameHeight;
  frame->options.method = method;
  return bench_of(name, frame);
}

// A cone of 45 degrees with a soft rim, as Blender's spots have, by 512 angles.
std::shared_ptr<const LightProfile> cone() {
  LightProfile profile;
  profile.horizontal = {0};
  constexpr int kAngles = 512;
  constexpr double kWidest = 22.5, kRim = 0.15;
  const auto cosine = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
  for (int i = 0; i <= kAngles; ++i) {
    const double angle = kWidest * i / kAngles,
                 t = std::clamp((cosine(angle) - cosine(kWidest)) / ((1 - cosine(kWidest)) * kRim), 0.0, 1.0);
    profile.vertical.push_back(angle);
    profile.candela.push_back(cosine(angle) * t * t * (3 - 2 * t));
  }
  return std::make_shared<const LightProfile>(std::move(profile));
}

Bench disk(const Where& where, const std::string& name, bool profiled, int threads) {
  auto frame = frame_on(where, threads);
  frame->scene = floor_scene();
  frame->scene.materials[0] = glossy();
  frame->scene.meshes.push_back(scene::quad_mesh({0.1f, 1, -0.3f}, {0.7f, 1, -0.3f}, {0.7f, 1, 0.3f}, {0.1f, 1, 0.3f}, 0));
  AreaLight light;
  light.shape = Ellipse{{0, 3, 0}, {0.1, 0, 0}, {0, 0, 0.1}};
  if (profiled) set_emission(light, cone(), {1, 0, 0});
  frame->options.shadows = Shadows::on;
  frame->scene.area_lights = {light};
  return bench_of(name, frame);
}

std::string box_file() { return std::string(STERADIAN_SCENES) + "/cornell.glb"; }
std::string gallery_file() { return std::string(STERADIAN_SCENES) + "/gallery.glb"; }

Bench gallery(const Where& where, const std::string& name, const std::string& method, int threads) {
  auto frame = frame_on(where, threads);
  frame->scene = load_scene(gallery_file()).scene;
  frame->options.method = method;
  return bench_of(name, frame);
}

Bench moved(const Where& where, const std::string& name, const std::string& method, int width, int height, int threads) {
  struct Moved {
    Scene scene;
    RenderCache cache{};
    double step = 0.01;
  };
  auto frame = frame_on(where, threads);
  frame->options.method = method;
  frame->options.width = width;
  frame->options.height = height;
  const auto moved = std::make_shared<Moved>(load_scene(gallery_file()).scene);
  return {name, static_cast<std::size_t>(width) * static_cast<std::size_t>(height), name_of(active_simd()),
          [frame, moved] {
            for (AreaLight& light : moved->scene.area_lights)
              if (auto* polygon = std::get_if<Polygon>(&light.shape))
                for (Vec3d& vertex : polygon->vertices) vertex.x += moved->step;
            moved->step = -moved->step;
            keep(render(moved->scene, frame->options, moved->cache).pixels.front());
          },
          false};
}

// The lamp goes round a small circle, so that no picture has the light of one before.
Bench dragged(const std::string& name, int width, int height, int threads) {
  struct Dragged {
    scene::GltfFile file = scene::read_gltf_file(box_file());
    LoadOptions loading{};
    int step = 0;
  };
  auto frame = frame_on({}, threads);
  frame->options.width = width;
  frame->options.height = height;
  frame->options.shadows = Shadows::on;
  frame->options.bounces = kAllBounces;
  frame->options.bounce_preview = true;
  frame->cached = true;
  const auto dragged = std::make_shared<Dragged>();
  dragged->loading.meshes = make_kept_meshes();
  const auto call = [frame, dragged] {
    for (auto& node : dragged->file.json["nodes"]) {
      if (node["name"] != "lamp") continue;
      const double angle = 0.5 * ++dragged->step;
      node["translation"][0] = 0.2 * std::cos(angle);
      node["translation"][2] = 0.2 * std::sin(angle);
    }
    frame->scene = scene::load_scene(dragged->file, dragged->loading).scene;
    frame->call();
  };
  return {name, static_cast<std::size_t>(width) * static_cast<std::size_t>(height), name_of(active_simd()), call, false, [frame] {
            return frame->medians();
          }};
}

struct Rays {
  Scene scene;
  RayScene rays;
  CameraRays camera;
  tbb::task_arena arena;

  Rays(Scene s, int threads) : scene(std::move(s)), rays(scene), camera(scene.cameras.at(0), kFrameWidth, kFrameHeight), arena(threads) {}
  void call() {
    constexpr int kAcross = (kFrameWidth + kTileSide - 1) / kTileSide, kDown = (kFrameHeight + kTileSide - 1) / kTileSide;
    arena.execute([&] {
      tbb::parallel_for(0, kAcross * kDown, [&](int i) {
        const FlushDenormals flush;
        const int x = i % kAcross * kTileSide, y = i / kAcross * kTileSide;
        TileHits hits;
        trace_tile(rays, camera, {x, y, std::min(kTileSide, kFrameWidth - x), std::min(kTileSide, kFrameHeight - y)}, pixel_place(0, 1),
                   hits);
        keep(hits.u);
      });
    });
  }
};

// The build writes this file beside the program's folder.
std::filesystem::path arcade() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "scenes" / "arcade.glb";
}

Bench frame_rays(const std::string& name, int threads) {
  auto work = std::make_shared<Rays>(load_scene(arcade().string()).scene, threads);
  return {name, std::size_t{kFrameWidth} * kFrameHeight, "", [work] { work->call(); }, false, {}};
}

// Adds a bench for one thread, and one for two threads under a separate name.
void frame_add(BenchList& list, const std::string& name, const std::function<Bench(const std::string&, int)>& make) {
  for (const int threads : {1, 2}) {
    const std::string one = threads == 1 ? name : name + "/threads=" + std::to_string(threads);
    list.add(one, [=](const BenchOptions&) { return make(one, threads); });
  }
}

}  // namespace

void add_frame(BenchList& list, const Where& where) {
  const bool on_cpu = where.backend == Backend::cpu;
  const std::string prefix = on_cpu ? "frame/" : "vulkan/frame/";
  // A device has its own threads, so there is one name, with all threads of the host.
  const auto add_by = [&](const std::string& name, auto make) {
    if (on_cpu)
      frame_add(list, prefix + name, make);
    else
      list.add(prefix + name, [=](const BenchOptions&) { return make(prefix + name, 0); });
  };
  for (const std::string method : {"exact", "ltc-compact", "ltc", "closed-form"})
    add_by("direct/" + method + "/1080p", [=](const std::string& name, int threads) { return direct(where, name, method, threads); });
  for (const bool profiled : {false, true})
    add_by(std::string("disk/") + (profiled ? "profiled" : "even") + "/720p",
           [=](const std::string& name, int threads) { return disk(where, name, profiled, threads); });
  if (std::filesystem::exists(gallery_file()))
    for (const std::string method : {"ltc-compact", "ltc", "closed-form"})
      add_by("gallery/" + method + "/720p", [=](const std::string& name, int threads) { return gallery(where, name, method, threads); });
  if (std::filesystem::exists(gallery_file()))
    for (const auto& [size, width, height] : {std::tuple{"80x45", 80, 45}, {"720p", 1280, 720}})
      add_by(std::string("moved/ltc-compact/") + size,
             [=](const std::string& name, int threads) { return moved(where, name, "ltc-compact", width, height, threads); });
  if (on_cpu && std::filesystem::exists(box_file()))
    for (const auto& [size, width, height] : {std::tuple{"320x180", 320, 180}, {"640x360", 640, 360}, {"720p", 1280, 720}})
      frame_add(list, std::string("frame/dragged/cornell/") + size,
                [=](const std::string& name, int threads) { return dragged(name, width, height, threads); });
  if (on_cpu && std::filesystem::exists(arcade())) frame_add(list, "frame/rays/arcade/1080p", frame_rays);
}

}  // namespace steradian::bench
