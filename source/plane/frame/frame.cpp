// Frames of the plane: by tiles if possible, pixel by pixel otherwise.
#include "plane/frame/frame.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/budget.h"
#include "plane/extras/extras.h"
#include "plane/extras/frame.h"
#include "plane/frame/emitters.h"
#include "plane/frame/tiles/lattice.h"
#include "steradian/error.h"

namespace steradian::plane {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

Picture averaged(const Picture& fine, int n) {
  Picture result(fine.width / n, fine.height / n);
  const auto average = [&](const std::vector<Vec3f>& from, std::vector<Vec3f>& to) {
    for (int y = 0; y < result.height; ++y)
      for (int x = 0; x < result.width; ++x) {
        Vec3f sum;
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i)
            sum += from[static_cast<std::size_t>(y * n + j) * static_cast<std::size_t>(fine.width) + static_cast<std::size_t>(x * n + i)];
        to[static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) + static_cast<std::size_t>(x)] =
            sum / static_cast<float>(n * n);
      }
  };
  average(fine.pixels, result.pixels);
  for (const auto& [name, layer] : fine.layers) {
    result.layers[name].resize(result.pixels.size());
    average(layer, result.layers[name]);
  }
  return result;
}

// Renders pixel by pixel: for every method except the exact one without moments.
void by_query(const PlaneWorld& world, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture) {
  if (options.moments)
    for (const char* name : {"moment_x", "moment_y"}) picture.layers[name].resize(picture.pixels.size());
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for(0, grid.height, [&](int y) {
    for (int x = 0; x < grid.width; ++x) {
      PlaneLight light = world.query(grid.at(x, y), options.method, options.sampling);
      if (options.bounces != nullptr) {
        const PlaneLight bounced = options.bounces->query(grid.at(x, y));
        light.radiance += bounced.radiance;
        light.moment_x += bounced.moment_x;
        light.moment_y += bounced.moment_y;
      }
      picture.at(x, y) = static_cast<Vec3f>(light.radiance);
      if (!options.moments) continue;
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
      picture.layers["moment_x"][i] = static_cast<Vec3f>(light.moment_x);
      picture.layers["moment_y"][i] = static_cast<Vec3f>(light.moment_y);
    }
    if (options.progress) options.progress(++done, static_cast<std::uint64_t>(grid.height));
  });
}

// A frame of the walls' errors alone, as a layer.
void add_bounce_error(const FillTiles& fill, const PlaneWorld::Impl& world, const PlaneFrameOptions& options, const PixelGrid& grid,
                      Budget& budget, Picture& picture) {
  const FrameLights errors{false, wall_emitters(options.bounces->impl(), WallLight::error), {}};
  Picture result(picture.width, picture.height);
  PlaneFrameStats unused;
  PlaneFrameOptions silent = options;
  silent.progress = nullptr;
  fill(prepare_frame(world, budget, errors), silent, grid, result, unused);
  picture.layers["bounce_error"] = std::move(result.pixels);
}

// Bodies that are lit within are a colour laid over their light.
void draw_occluders(const PlaneWorld::Impl& world, PlaneOccluders occluders, const PixelGrid& grid, Picture& picture) {
  if (occluders == PlaneOccluders::black) return;
  const bool clear = occluders == PlaneOccluders::clear;
  std::vector<Vec3f>* alpha = nullptr;
  if (clear) alpha = &picture.layers["alpha"], alpha->assign(picture.pixels.size(), Vec3f{1, 1, 1});
  tbb::parallel_for(0, grid.height, [&](int y) {
    for (int x = 0; x < grid.width; ++x) {
      const int body = world.occluder_at(grid.at(x, y));
      if (body < 0) continue;
      const Matter matter = world.extras ? world.extras->matter[static_cast<std::size_t>(body)] : Matter::opaque;
      const bool lit = matter == Matter::clear || matter == Matter::deep;
      if (lit && clear) continue;
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
      if (clear)
        (*alpha)[i] = {};
      else
        picture.pixels[i] =
            (lit ? picture.pixels[i] : Vec3f{1, 1, 1}) * static_cast<Vec3f>(world.scene.bodies[static_cast<std::size_t>(body)].color);
    }
  });
}

}  // namespace

PixelGrid grid_of(const PlaneScene& scene, int width, int height) {
  const Vec2d step{scene.width / width, scene.height / height};
  if (scene.fit == PlaneFit::stretch || step.x == step.y) return {scene.origin, step, width, height};
  const double unit = scene.fit == PlaneFit::meet ? std::max(step.x, step.y) : std::min(step.x, step.y);
  const Vec2d room = Vec2d{scene.width, scene.height} - Vec2d{unit * width, unit * height};
  return {scene.origin + Vec2d{room.x * scene.align.x, room.y * scene.align.y}, {unit, unit}, width, height};
}

}  // namespace steradian::plane

namespace steradian {

Picture render_plane(const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats) {
  Picture picture;
  render_plane_into(picture, world, options, stats);
  return picture;
}

void render_plane_into(Picture& result, const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats) {
  const plane::FillTiles by_packs = [](const plane::FrameScene& frame, const PlaneFrameOptions& o, const plane::PixelGrid& grid,
                                       Picture& picture, PlaneFrameStats& counts) { render_tiles(frame, o, grid, picture, counts); };
  plane::render_plane_with(by_packs, result, world, options, stats);
}

}  // namespace steradian

namespace steradian::plane {

void render_plane_with(const FillTiles& fill, Picture& result, const PlaneWorld& world, const PlaneFrameOptions& options,
                       PlaneFrameStats* stats) {
  const PlaneScene& scene = world.scene();
  const World& inner = world.impl();
  const int n = static_cast<int>(std::ceil(std::sqrt(std::max(options.aa, 1)) - 1e-9));
  const int width = options.width > 0 ? options.width : std::max(static_cast<int>(std::lround(scene.width)), 1);
  const int height = options.height > 0 ? options.height : std::max(static_cast<int>(std::lround(scene.height)), 1);
  if (static_cast<double>(width) * n > 65536 || static_cast<double>(height) * n > 65536)
    throw Error("size", "the picture would have more than 65536 pixels a side", "set a smaller size");
  if (options.bounces != nullptr && options.method != PlaneMethod::exact)
    throw Error("method", "bounces are added to exact light only", "use exact");
  Budget budget(options.limits);
  const auto pixels = static_cast<std::uint64_t>(width * n) * static_cast<std::uint64_t>(height * n);
  budget.take_memory(
      scene.name, "a picture of " + std::to_string(width * n) + " x " + std::to_string(height * n) + " pixels (--size makes it smaller)",
      pixels * sizeof(Vec3f) *
          ((options.moments ? 3 : 1) + (options.bounce_error ? 2 : 0) + (options.bounces != nullptr && options.bounce_lattice > 0 ? 1 : 0) +
           (options.occluders == PlaneOccluders::clear ? 1 : 0)) *
          (n > 1 ? 2 : 1));
  Picture fine;
  Picture& picture = n > 1 ? fine : result;
  picture.layers.clear();
  picture.width = width * n;
  picture.height = height * n;
  try {
    picture.pixels.resize(pixels);
  } catch (const std::bad_alloc&) {
    throw budget.out_of_memory();
  }
  PlaneFrameStats own;
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  own.threads = arena.max_concurrency();
  for (const PlaneBody& body : scene.bodies) ++(body.light ? own.lights : own.occluders);
  arena.execute([&] {
    const auto start = Clock::now();
    const PixelGrid grid = grid_of(inner.scene, picture.width, picture.height);
    if (inner.extras && options.method == PlaneMethod::exact && (options.moments || inner.extras->changes_frames(inner.scene))) {
      draw_with_extras(inner, options, grid, budget, picture);
      own.frame_ms = ms_since(start);
    } else if (options.method != PlaneMethod::exact || options.moments) {
      by_query(world, options, grid_of(scene, picture.width, picture.height), picture);
      own.frame_ms = ms_since(start);
    } else {
      try {
        FrameLights lights;
        if (options.bounces != nullptr) {
          lights.walls = wall_emitters(options.bounces->impl(), WallLight::radiance);
          lights.walls_at = [&](Vec2d p) { return options.bounces->query(p / inner.scale).radiance; };
        }
        const bool lattice = options.bounces != nullptr && options.bounce_lattice > 0;
        FrameScene walls;
        if (lattice) walls = prepare_frame(inner, budget, {false, std::move(lights.walls), lights.walls_at});
        const FrameScene frame = prepare_frame(inner, budget, lattice ? FrameLights{} : lights);
        own.prepare_ms = ms_since(start);
        const auto tiles = Clock::now();
        fill(frame, options, grid, picture, own);
        if (inner.extras) add_extras(inner, grid, budget, picture);
        if (lattice) {
          const LatticeError error = add_by_lattice(walls, options, grid, options.bounce_lattice, picture, own);
          own.lattice_error = error.largest;
          own.lattice_drawn = error.drawn;
        }
        own.frame_ms = ms_since(tiles);
        if (options.bounces != nullptr && options.bounce_error) add_bounce_error(fill, inner, options, grid, budget, picture);
      } catch (const std::bad_alloc&) {
        throw budget.out_of_memory();
      }
    }
    draw_occluders(inner, options.occluders, grid, picture);
  });
  if (stats != nullptr) *stats = own;
  if (n > 1) result = averaged(picture, n);
}

}  // namespace steradian::plane
