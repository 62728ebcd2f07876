#include "steradian/render.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <memory>

#include "core/float_mode.h"
#include "render/cpu/direct.h"
#include "render/cpu/gbuffer.h"
#include "steradian/error.h"

namespace steradian {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Thread time of a pass, summed over tiles.
class PassClock {
 public:
  explicit PassClock(std::string name) : name_(std::move(name)) {}
  template <class Work>
  void run(Work work) {
    const auto start = Clock::now();
    work();
    nanoseconds_ += std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
  }
  PassTime time(int threads) const { return {name_, static_cast<double>(nanoseconds_) * 1e-6 / threads}; }

 private:
  std::string name_;
  std::atomic<std::int64_t> nanoseconds_{0};
};

struct Frame2d {
  const RenderOptions& options;
  int tiles_x, tiles_y;
  explicit Frame2d(const RenderOptions& o)
      : options(o), tiles_x((o.width + kTileSide - 1) / kTileSide), tiles_y((o.height + kTileSide - 1) / kTileSide) {}
  int count() const { return tiles_x * tiles_y; }
  TileArea area(int index) const {
    const int x = index % tiles_x * kTileSide, y = index / tiles_x * kTileSide;
    return {x, y, std::min(kTileSide, options.width - x), std::min(kTileSide, options.height - y)};
  }
};

void accumulate(const SurfaceTile& tile, TileArea area, float weight, Picture& picture) {
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x) {
      const std::size_t i = tile_slot(x, y);
      picture.at(area.x + x, area.y + y) +=
          Vec3f{tile.radiance.x[i], tile.radiance.y[i], tile.radiance.z[i]} * weight;
    }
}

}  // namespace

Picture render(const Scene& scene, const RenderOptions& options, RenderStats* stats) {
  const auto start = Clock::now();
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const Camera& camera = find_camera(scene, options.camera);
  const CameraRays camera_rays(camera, options.width, options.height);
  const auto build_start = Clock::now();
  const RayScene rays(scene);
  const double build_ms = ms_since(build_start);
  const std::vector<PackLight> lights = prepare_lights(scene);
  const DirectTable& direct = direct_table_for(active_simd());
  const Frame2d frame(options);
  Picture picture(options.width, options.height);

  PassClock gbuffer_clock("gbuffer"), direct_clock("direct");
  std::atomic<std::uint64_t> done{0};
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(0, frame.count(), [&](int index) {
      const FlushDenormals flush;
      const auto tile = std::make_unique<SurfaceTile>();
      const TileArea area = frame.area(index);
      for (int s = 0; s < options.aa; ++s) {
        gbuffer_clock.run([&] { fill_tile(scene, rays, camera_rays, area, pixel_place(s, options.aa), *tile); });
        direct_clock.run([&] {
          if (!tile->any_diffuse) return;
          const auto reaching = lights_reaching(lights, *tile);
          direct.add_diffuse(*tile, reaching.data(), reaching.size());
        });
        accumulate(*tile, area, 1.0f / static_cast<float>(options.aa), picture);
      }
      if (options.progress) options.progress(++done, static_cast<std::uint64_t>(frame.count()));
    });
  });

  if (stats != nullptr) {
    stats->passes = {{"build", build_ms}, gbuffer_clock.time(threads), direct_clock.time(threads)};
    stats->total_ms = ms_since(start);
    stats->threads = threads;
    stats->lights = lights.size();
    stats->triangles = scene.triangle_count();
    stats->method = options.method;
  }
  return picture;
}

}  // namespace steradian
