#include "device/frame/frame.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/float_mode.h"
#include "device/frame/kept_on_device.h"
#include "render/bounce/pipeline.h"
#include "render/frame/frame_surfaces.h"
#include "render/frame/methods.h"
#include "render/frame/tile_lighting.h"
#include "render/lights/light_bounds.h"
#include "steradian/error.h"

namespace steradian::vulkan {
namespace {

void add_radiance(const TileVector& v, TileVector& to) {
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    to.x[i] += v.x[i];
    to.y[i] += v.y[i];
    to.z[i] += v.z[i];
  }
}

bool has_bent_coats(const SurfaceMaterial& m) {
  return m.clearcoat > 0 && (m.normal_texture.image >= 0 || m.clearcoat_normal_texture.image >= 0);
}

// The first feature of the picture that the device does not have; empty: it has all.
std::string first_lack(const Scene& scene, const RenderOptions& options, const DeviceInfo& device, const std::vector<PackLight>& lights,
                       const DirectPass& direct) {
  if (options.shadows != steradian::Shadows::off && !DeviceShadows::has(device))
    return "'" + device.name + "' has no shadows: its subgroups cannot add, or it has no whole numbers of 64 bits";
  if (options.indirect.mode == IndirectMode::path) return "it has no bounce by paths";
  if (options.indirect.mode == IndirectMode::ltc_outgoing) return "it has no --indirect ltc-outgoing";
  if (options.indirect.mode != IndirectMode::off && options.indirect.shadow_rays > 0) return "it has no --indirect-shadows";
  for (const Mesh& mesh : scene.meshes) {
    const SurfaceMaterial& m = scene.materials[static_cast<std::size_t>(mesh.material)];
    if (m.unlit || mesh.is_light_shape || mesh.indices.empty()) continue;
    for (const Material& lobe : m.specular_override)
      if (!direct.own_lobes().has(lobe))
        return std::string("it has no shader for the ") + name_of(lobe.brdf) + " lobe of material '" + m.name + "'";
    if (options.shadows != steradian::Shadows::off && light_passes(scene, mesh))
      return "it has no shadows of the clear material '" + m.name + "'";
    if (options.shadows != steradian::Shadows::off && has_bent_coats(m))
      return "it has no shadows for the coat of material '" + m.name + "', whose normal is not the surface's";
  }
  for (const PackLight& light : lights) {
    if (light.profiled != nullptr) return "it has no shader for the profiled light '" + light.area->name + "'";
    if (light.textured != nullptr && options.shadows != steradian::Shadows::off)
      return "it has no shadows under the textured light '" + light.area->name + "'";
    if (light.textured != nullptr && !options.table.empty()) return "it has no --table under the textured light '" + light.area->name + "'";
    if (!direct.has(light))
      return (light.area == nullptr ? std::string("a profiled point light") : "the textured light '" + light.area->name + "'") +
             " exceeds its buffers";
  }
  return {};
}

DirectMethod chosen(const Scene& scene, const RenderOptions& options) {
  const std::string lack = lack_of_devices(scene, options);
  if (!lack.empty()) throw UsageError("--backend vulkan", "cannot render this picture: " + lack, "use --backend cpu");
  return choose_method(scene, options);
}

// The cache's objects, created anew if the cached ones are on another device.
std::shared_ptr<KeptOnDevice> kept_of(std::shared_ptr<const Device> device, const std::string& name, RenderCache* cache) {
  const auto make = [&] { return std::make_shared<KeptOnDevice>(device != nullptr ? std::move(device) : open_device({name, false})); };
  if (cache == nullptr) return make();
  auto& [kept, kept_name] = cache->parts().on_device;
  if (kept == nullptr || (device != nullptr ? kept->device != device : kept_name != name)) {
    kept.reset();
    kept = make();
    kept_name = name;
  }
  return kept;
}

SceneParts parts_of(const Scene& scene, const RenderOptions& options, RenderCache* cache) {
  const Sorted sorted = options.shadows != steradian::Shadows::off ? Sorted::for_rays_and_edges : Sorted::for_rays;
  return cache != nullptr ? cache->parts().follow(scene, sorted) : SceneParts::of(scene, sorted);
}

// Returns null if they exceed a buffer.
std::shared_ptr<const SceneRays> rays_of(const Scene& scene, const std::shared_ptr<const Device>& device, RenderCache* cache) {
  if (cache == nullptr) return SceneRays::of(device, scene);
  auto& kept = cache->parts().device_rays;
  if (kept == nullptr || &kept->device() != device.get()) kept = SceneRays::of(device, scene);
  return kept;
}

// The view through one primary sample of a tile, past as many surfaces as `layer` says.
struct Job {
  int tile;
  std::unique_ptr<PassedRays::Ways> ways;  // past those surfaces; null in front of the first one
  bool passing = false;                    // light also passes the surfaces found
};

}  // namespace

std::string lack_of_devices(const Scene& scene, const RenderOptions& options) {
  if (options.bounces != 0 && options.bound) return "it has no --bound";
  if (options.time_limit > 0) return "it has no --time-limit";
  if (options.lights == LightSum::tree) return "it has no --lights tree";
  return choose_method(scene, options).estimates() ? "it has no method " + options.method : std::string();
}

struct DeviceFrame::Parts {
  Parts(const Scene& s, const RenderOptions& o, std::shared_ptr<const Device> d, SurfacesBy by, RaysBy rays, RenderCache* cache)
      : scene(s),
        options(o),
        threads(o.threads > 0 ? o.threads : tbb::info::default_concurrency()),
        method(chosen(s, o)),
        kept(kept_of(std::move(d), o.device, cache)),
        device(kept->device),
        parts(parts_of(s, o, cache)),
        surfaces(s, o, parts, method.table.get()),
        lights(prepare_lights(s, surfaces.environment_spots())),
        host(s, o, method, lights, parts, nullptr),
        direct(kept->direct, s, method, lights),
        arena(threads) {
    for (const PackLight& light : lights) light_pointers.push_back(&light);
    lacks = first_lack(s, o, device->info(), lights, direct);
    if (!lacks.empty()) return;
    const bool maps =
        has_bounce() && all_cast_exactly(s) && (rays == RaysBy::device || (rays == RaysBy::automatic && !device->info().software));
    if (maps || host.has_shadows()) device_rays = rays_of(s, device, cache);
    if (host.has_shadows() && device_rays == nullptr) {
      lacks = "its buffers have no space for the " + std::to_string(s.triangle_count()) + " triangles that shadow rays may meet";
      return;
    }
    if (host.has_shadows() && !DeviceShadows::fits(device->info(), *parts.shadows, lights)) {
      lacks = "its buffers have no space for the edges of " + std::to_string(s.triangle_count()) + " triangles before " +
              std::to_string(lights.size()) + " lights";
      return;
    }
    if (has_bounce()) {
      bounce = &made(kept->bounce, *device);
      bounce->find_first_hits_by(maps ? device_rays : nullptr);
    }
    kept_on_host = keeps_surfaces_on_host();
    if (by == SurfacesBy::device && !kept_on_host.empty())
      throw UsageError("--backend vulkan", "the device cannot find the surfaces (" + kept_on_host + ")");
    if (by == SurfacesBy::device || (by == SurfacesBy::automatic && kept_on_host.empty() && !device->info().software))
      raster.emplace(made(kept->raster, *device), s, *parts.maps, surfaces.camera(), o, direct.tiles_of_batch(), host_needs_surfaces());
    build_ms = ms_since(start);
  }

  bool has_bounce() const { return options.indirect.mode != IndirectMode::off; }
  bool stopped() const { return options.stop != nullptr && options.stop->load(std::memory_order_relaxed); }

  template <class Work>
  void each(std::size_t count, Work work) {
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const FlushDenormals flush;
        work(i);
      });
    });
  }

  // The surfaces of a job, and the light that the host adds to them after the device.
  SurfaceTile& tile_of(std::size_t job) { return *job_tiles[job]; }

  // Returns true if the host needs the surfaces that the device finds.
  bool host_needs_surfaces() const { return host.has_shadows() || has_bounce() || surfaces.environment() != nullptr; }

  // Lists the lights that may reach a tile whose surfaces the device has found and the host does not need.
  void list_found(std::size_t place, DirectPass::Tile& tile) {
    RasterSurfaces::find_squares(direct.radiance(), place, tile);
    SurfaceBounds all;
    for (const DirectPass::Square& square : tile.squares) add(all, square.bounds);
    if (!all.positions.is_empty()) tile.lights = lights_reaching(light_pointers, all);
    direct.list_lights(tile);
  }

  // Finds the surfaces of the jobs, puts them on the device, and lists the lights that may reach them.
  std::vector<DirectPass::Tile> find_surfaces(std::vector<Job>& jobs, int sample, int layer) {
    std::vector<DirectPass::Tile> tiles(jobs.size());
    if (shadowed.size() < jobs.size()) shadowed.resize(jobs.size(), TileShadows());
    while (host.has_shadows() && job_tiles.size() < jobs.size()) job_tiles.push_back(std::make_unique<SurfaceTile>());
    const bool drawn = raster && layer == 0;
    if (drawn)
      device_clock.run([&] { raster->find(jobs.front().tile, static_cast<int>(jobs.size()), direct.surfaces(), direct.radiance()); });
    each(jobs.size(), [&](std::size_t i) {
      Job& job = jobs[i];
      const bool found = drawn && !device->only_compiles() && !RasterSurfaces::is_for_host(direct.radiance(), i);
      if (found && !host_needs_surfaces()) {
        shadowed[i].clear();
        return lists_clock.run([&] { list_found(i, tiles[i]); });
      }
      SurfaceTile& tile = host.has_shadows() ? tile_of(i) : *workspaces.local();
      TilePlane distances{};
      if (found)
        upload_clock.run([&] {
          raster->take(direct.radiance(), i, tile);
          tile.seed = surfaces.seed(job.tile, sample);
          surfaces.add_background(job.tile, sample, tile);
        });
      else if (job.ways)
        surfaces.fill_behind(job.tile, sample, tile, *job.ways);
      else
        distances = surfaces.fill(job.tile, sample, tile);
      if (bounced && sample == 0 && layer == 0) capture_clock.run([&] { bounced->take(tile, surfaces.area(job.tile)); });
      surfaces.add_environment(job.tile, sample, tile);
      lists_clock.run([&] { tiles[i].lights = lights_reaching(light_pointers, tile); });
      shadowed[i].clear();
      tiles[i].lights.lights = host.hand_over_shadows(tile, tiles[i].lights.lights, shadowed[i]);
      lists_clock.run([&] {
        direct.find_squares(tile, tiles[i]);
        direct.list_lights(tiles[i]);
      });
      upload_clock.run([&] { found ? direct.put_radiance(i, tile) : direct.put(i, tile); });
      for (TilePlane* plane : {&tile.radiance.x, &tile.radiance.y, &tile.radiance.z}) plane->fill(0);
      job.passing = tile.any_passing && layer + 1 < kMostLayers;
      if (!job.passing) return;
      // The fractions of this layer are still needed; those of the next one are stored beside them.
      if (job.ways) {
        next_ways[i] = std::make_unique<PassedRays::Ways>(*job.ways);
      } else {
        next_ways[i] = std::make_unique<PassedRays::Ways>();
        PassedRays::begin(distances, *next_ways[i]);
      }
      surfaces.look_through(tile, *next_ways[i]);
    });
    return tiles;
  }

  // Lights as many tiles at once as there is capacity for their shadows' data, each time by one submission. The host adds the light of
  // points that the device leaves to the tiles' surfaces.
  void light_tiles(std::vector<DirectPass::Tile>& tiles) {
    const std::span all(shadowed.data(), tiles.size());
    if (!host.has_shadows() || std::all_of(all.begin(), all.end(), [](const TileShadows& s) { return s.by_light.empty(); }))
      return direct.run(tiles);
    if (!shadows) shadows.emplace(made(kept->shadows, *device), *device_rays, parts.shadows);
    for (std::size_t first = 0; first < tiles.size();) {
      const std::size_t end = first + shadows->upload(all.subspan(first));
      std::uint32_t states = 0;
      for (std::size_t i = first; i < end; ++i) {
        tiles[i].shadowed.clear();
        for (const TileShadows::Light& light : shadowed[i].by_light) {
          tiles[i].shadowed.push_back({light.light, states, light.searched, light.shares});
          states += static_cast<std::uint32_t>(kTilePixels);
        }
      }
      direct.run(tiles, first, end,
                 {[&](const Buffer& gates) -> ComputeProgram& { return shadows->record(gates); }, &shadows->states(), &shadows->parts()});
      if (!shadows->finish()) continue;
      each(end - first, [&](std::size_t i) {
        shadows->each_left(i, [&](const PackLight& light, const TilePoints& points) { host.add_at(tile_of(first + i), points, light); });
      });
      first = end;
    }
  }

  // Lights the jobs and adds them to the picture; returns those that may have more surfaces behind.
  std::vector<Job> light(std::vector<Job> jobs, int sample, int layer, Picture& picture) {
    next_ways.clear();
    next_ways.resize(jobs.size());
    std::vector<DirectPass::Tile> tiles = find_surfaces(jobs, sample, layer);
    device_clock.run([&] { light_tiles(tiles); });
    const float weight = 1.0f / static_cast<float>(options.aa);
    each(jobs.size(), [&](std::size_t i) {
      resolve_clock.run([&] {
        TileVector& radiance = *radiances.local();
        direct.take_radiance(i, radiance);
        if (host.has_shadows()) add_radiance(tile_of(i).radiance, radiance);
        add_to_picture(radiance, surfaces.area(jobs[i].tile), jobs[i].ways ? &jobs[i].ways->shares : nullptr, weight, picture.pixels,
                       options.width);
      });
    });
    std::vector<Job> next;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      if (!jobs[i].passing) continue;
      next.push_back(std::move(jobs[i]));
      next.back().ways = std::move(next_ways[i]);
    }
    return next;
  }

  // Reason why the device does not find the surfaces; empty: it does.
  std::string keeps_surfaces_on_host() const {
    if (static_cast<std::size_t>(std::max(options.width, options.height)) > device->info().picture)
      return "a picture larger than the device draws";
    return what_keeps_on_host(scene, device->info());
  }

  Picture render() {
    Picture picture(options.width, options.height);
    if (has_bounce()) bounced.emplace(scene, surfaces.rays(), options, threads, bounce);
    const int count = surfaces.tile_count(), batch = static_cast<int>(direct.tiles_of_batch()), batches = (count + batch - 1) / batch;
    std::uint64_t done = 0;
    // A device that finds the surfaces draws the whole picture for each sample. The host's rays can start at any tile.
    for (int step = 0; step < batches * options.aa && !stopped(); ++step) {
      const int sample = raster ? step / batches : step % options.aa, first = (raster ? step % batches : step / options.aa) * batch;
      if (raster && first == 0) device_clock.run([&] { raster->look(sample); });
      std::vector<Job> jobs;
      for (int tile = first; tile < std::min(first + batch, count); ++tile) jobs.push_back({tile, nullptr, false});
      const std::uint64_t now_done = done + jobs.size();
      for (int layer = 0; !jobs.empty(); ++layer) jobs = light(std::move(jobs), sample, layer, picture);
      // With bounces the host's work tells the progress.
      while (options.progress && options.bounces == 0 && done < now_done)
        options.progress(++done, static_cast<std::uint64_t>(count) * static_cast<std::uint64_t>(options.aa));
    }
    if (bounced && !stopped()) arena.execute([&] { bounced->add_to(picture); });
    return picture;
  }

  void report(RenderStats& stats) {
    stats.passes = {{"build", build_ms},        surfaces.rays_time(threads), surfaces.gbuffer_time(threads), lists_clock.time(threads),
                    upload_clock.time(threads), device_clock.time(1),        resolve_clock.time(threads)};
    if (raster)
      for (const auto& [name, ms] : raster->times()) stats.passes.push_back({"device: " + name, ms});
    for (const auto& [name, ms] : direct.times()) stats.passes.push_back({"device: " + name, ms});
    if (host.has_shadows()) {
      for (const PassTime& pass : {host.shadow_time(threads), host.direct_time(threads), host.specular_time(threads)})
        stats.passes.push_back(pass);
      const ShadowCounts counts = host.shadow_counts();
      const std::uint64_t found = shadows ? shadows->found() : 0, points = counts.points + (shadows ? shadows->points() : 0);
      const auto share = [](std::uint64_t some, std::uint64_t all) {
        return all > 0 ? static_cast<double>(some) / static_cast<double>(all) : 0;
      };
      stats.shadow_fallback = share(counts.fallback, points);
      stats.shadow_on_host = share(counts.parts + counts.fallback, counts.parts + counts.fallback + found);
      if (shadows) {
        stats.shadow_pairs = shadows->pairs();
        stats.shadow_looks = shadows->looks();
        stats.shadow_gathered = shadows->gathered();
        stats.shadow_work = shadows->work();
      }
      if (shadows && shadows->time() > 0) stats.passes.push_back({"device: shadows", shadows->time()});
      if (shadows && shadows->rays_time() > 0) stats.passes.push_back({"device: shadow rays", shadows->rays_time()});
    }
    if (const auto* environment = surfaces.environment()) {
      stats.passes.front().ms -= surfaces.environment_build_ms();
      stats.passes.push_back({"environment: maps", surfaces.environment_build_ms()});
      stats.passes.push_back(surfaces.environment_time(threads));
      stats.environment_spots = environment->share_of_spots();
      stats.diffuse_residual = environment->diffuse_residual();
      stats.specular_residual = environment->specular_residual();
      stats.environment_shadow_error = surfaces.environment_shadow_error();
    }
    if (bounced) stats.passes.push_back(capture_clock.time(threads));
    for (PassTime& pass : stats.passes) pass.ms -= std::exchange(reported[pass.name], pass.ms);
    if (bounced)  // passes of this frame alone
      for (const PassTime& pass : bounced->passes()) stats.passes.push_back({"indirect: " + pass.name, pass.ms});
    stats.threads = threads;
    stats.lights = lights.size();
    stats.triangles = scene.triangle_count();
    stats.method = method.name;
    stats.device = device->info().name;
    stats.warnings = lobes_under_means(scene, method);
    if (raster)
      for (std::string& sentence : materials_for_host(scene)) stats.warnings.push_back(std::move(sentence));
    else if (!device->info().software)
      stats.warnings.push_back("the CPU finds the surfaces (" + kept_on_host + ")");
  }

  const Clock::time_point start = Clock::now();
  const Scene& scene;
  const RenderOptions& options;
  const int threads;
  const DirectMethod method;
  const std::shared_ptr<KeptOnDevice> kept;
  const std::shared_ptr<const Device> device;
  const SceneParts parts;
  FrameSurfaces surfaces;
  const std::vector<PackLight> lights;
  std::vector<const PackLight*> light_pointers;
  TileLighting host;
  DirectPass direct;
  std::shared_ptr<const SceneRays> device_rays;  // null without shadows, and if the host traces the bounce's shadow map
  std::string lacks;
  std::string kept_on_host;
  std::optional<DeviceShadows> shadows;  // created on first use
  std::vector<TileShadows> shadowed;     // by job
  std::vector<std::unique_ptr<SurfaceTile>> job_tiles;
  std::optional<RasterSurfaces> raster;       // none if the host finds the surfaces
  Bounce* bounce = nullptr;                   // null without a bounce
  std::optional<indirect::Pipeline> bounced;  // bounce of one frame
  tbb::task_arena arena;
  double build_ms = 0;
  PassClock lists_clock{"lists"}, upload_clock{"upload"}, device_clock{"device"}, resolve_clock{"resolve"},
      capture_clock{"indirect: surfaces"};
  std::vector<std::unique_ptr<PassedRays::Ways>> next_ways;  // by job
  tbb::enumerable_thread_specific<std::unique_ptr<SurfaceTile>> workspaces{[] { return std::make_unique<SurfaceTile>(); }};
  tbb::enumerable_thread_specific<std::unique_ptr<TileVector>> radiances{[] { return std::make_unique<TileVector>(); }};
  std::map<std::string, double> reported;  // milliseconds of passes up to the last report
};

DeviceFrame::DeviceFrame(const Scene& scene, const RenderOptions& options, std::shared_ptr<const Device> device, SurfacesBy surfaces,
                         RaysBy rays, RenderCache* cache)
    : parts_(std::make_unique<Parts>(scene, options, std::move(device), surfaces, rays, cache)) {}
DeviceFrame::~DeviceFrame() = default;

const std::string& DeviceFrame::lacks() const { return parts_->lacks; }

Picture DeviceFrame::render(RenderStats* stats) {
  if (!lacks().empty()) throw UsageError("--backend vulkan", "cannot render all of this picture: " + lacks(), "use --backend cpu");
  const auto start = Clock::now();
  const std::size_t submitted = parts_->device->submissions();
  Picture picture = parts_->render();
  if (stats != nullptr) {
    parts_->report(*stats);
    stats->submissions = parts_->device->submissions() - submitted;
    stats->total_ms = ms_since(start);
  }
  return picture;
}

}  // namespace steradian::vulkan
