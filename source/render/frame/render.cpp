#include "render/frame/render.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/float_mode.h"
#include "render/bounce/pipeline.h"
#include "render/frame/all_light.h"
#include "render/frame/frame_surfaces.h"
#include "render/frame/methods.h"
#include "render/frame/surface_light.h"
#include "render/frame/tile_lighting.h"
#include "render/frame/timed_picture.h"
#include "render/lights/solid_lights.h"
#include "render/radiosity/kept_patches.h"
#include "render/sampled/monte_carlo.h"
#include "render/sampled/paths.h"
#include "render/sampled/through_glass.h"
#include "render/surface/gbuffer.h"
#include "render/tile/pass_clock.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"

namespace steradian {
namespace {

// Result of a pilot run of `reference` for a tile.
struct Pilot {
  double variance = 0;  // variance of one pair of samples, summed over pixels and channels
  double square = 0;    // square of the radiance, likewise
};

constexpr int kPilotPairs = 32;  // enough to rank tiles; the final estimate does not use them
constexpr int kMinPairs = 64;    // with fewer, the estimated variance is too rough for a z-test
constexpr int kMaxPairs = 1 << 16;

class Renderer {
 public:
  Renderer(const Scene& scene, const RenderOptions& options, RenderCache* cache, LightOf of)
      : scene_(scene),
        options_(options),
        of_(of),
        threads_(options.threads > 0 ? options.threads : tbb::info::default_concurrency()),
        method_(choose_method(scene, options)),
        cache_(cache),
        parts_(tbb::task_arena(threads_).execute(
            [&] { return cache != nullptr ? cache->parts().follow(scene, sorted()) : SceneParts::of(scene, sorted()); })),
        surfaces_(scene, options, parts_, method_.table.get(), method_.estimates()),
        lights_(own_lights()),
        many_lights_(prepare_many_lights()),
        lighting_(scene, options, method_, lights_, parts_, many_lights_.get()),
        tinted_(scene, options, method_, lights_, many_lights_.get()),
        samplers_([this] {
          return std::make_unique<DirectSampler>(scene_, options_.shadows != Shadows::off ? &surfaces_.rays() : nullptr,
                                                 environment() != nullptr ? &environment()->sampler() : nullptr, options_.terminator,
                                                 method_.table.get());
        }),
        arena_(threads_) {
    const auto is_solid = [](const PackLight& light) { return light.solid != nullptr; };
    if (options.bounces != 0 && std::any_of(lights_.begin(), lights_.end(), is_solid))
      faces_ = std::make_unique<FaceLights>(scene_, options_, method_, parts_, surfaces_.environment_spots());
    if (options.indirect.mode != IndirectMode::off) indirect_.emplace(scene_, surfaces_.rays(), options_, threads_);
    build_ms_ = ms_since(start_);
  }

  Picture render(RenderState& state) {
    begin(state);
    std::vector<int> pairs(state.done.size(), options_.spp);
    steps_ = static_cast<std::uint64_t>(tile_count());
    if (options_.bounces != 0 && !method_.estimates()) solve_bounces();
    if (is_limited()) {
      render_within_limit(state);
      return std::move(state.picture);
    }
    if (method_.kind == MethodKind::reference && options_.target_error > 0) pairs = plan_pairs();
    if (in_blocks()) {
      each_block([&](const std::vector<int>& tiles) {
        // A block is either completely done or not at all.
        const auto done = [&](int index) -> std::uint8_t& { return state.done[static_cast<std::size_t>(index)]; };
        if (std::all_of(tiles.begin(), tiles.end(), done)) {
          for (const int index : tiles) take_surfaces(index);
          return;
        }
        render_block(tiles, state.picture);
        for (const int index : tiles) stopped() ? clear_area(area(index), state.picture) : void(done(index) = 1);
      });
    } else {
      each_tile([&](int index) {
        const auto tile = static_cast<std::size_t>(index);
        if (state.done[tile] != 0) return take_surfaces(index);
        render_tile(index, pairs[tile], state.picture, {});
        // A tile that was stopped on its way lacks samples, so its result is discarded.
        stopped() ? clear_area(area(index), state.picture) : void(state.done[tile] = 1);
      });
    }
    Picture picture = options_.stop != nullptr ? state.picture : std::move(state.picture);  // no copy is needed if nothing can stop it
    if (indirect_ && !stopped()) arena_.execute([&] { indirect_->add_to(picture); });
    if (all_light_ && !stopped()) arena_.execute([&] { all_light_->finish(picture); });
    return picture;
  }

  bool stopped() const { return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed); }

  void report(RenderStats& stats, const Picture& picture) const {
    stats.passes = {{"build", build_ms_},
                    surfaces_.rays_time(threads_),
                    surfaces_.gbuffer_time(threads_),
                    {"direct", lighting_.direct_time(threads_).ms + block_clock_.time(threads_).ms},
                    lighting_.specular_time(threads_)};
    if (method_.estimates()) stats.passes.push_back(sampling_clock_.time(threads_));
    if (environment() != nullptr) {
      stats.passes.front().ms -= surfaces_.environment_build_ms();
      stats.passes.push_back({"environment: maps", surfaces_.environment_build_ms()});
      stats.passes.push_back(surfaces_.environment_time(threads_));
      stats.environment_spots = environment()->share_of_spots();
      stats.diffuse_residual = environment()->diffuse_residual();
      stats.specular_residual = environment()->specular_residual();
      stats.environment_shadow_error = surfaces_.environment_shadow_error();
    }
    if (many_lights_) many_lights_->report(stats);
    if (all_light_) {
      stats.passes.push_back({"bounces: patches", patches_ms_});
      all_light_->report(threads_, stats, picture);
    }
    if (lighting_.has_shadows()) {
      stats.passes.push_back(lighting_.shadow_time(threads_));
      stats.shadow_fallback = lighting_.shadow_fallback();
      stats.shadows_estimated = lighting_.shadows_estimated();
      stats.exact_tiles = exact_tiles_;
      stats.estimated_shadow_error = estimated_error_;
    }
    if (indirect_) {
      stats.passes.push_back(capture_clock_.time(threads_));
      for (const PassTime& pass : indirect_->passes()) stats.passes.push_back({"indirect: " + pass.name, pass.ms});
    }
    stats.total_ms = ms_since(start_);
    stats.threads = threads_;
    stats.lights = lights_.size();
    stats.triangles = scene_.triangle_count();
    stats.method = method_.name;
    stats.warnings = lobes_under_means(scene_, method_);
  }

 private:
  static std::vector<const PackLight*> pointers_to(const std::vector<PackLight>& lights) {
    std::vector<const PackLight*> pointers;
    for (const PackLight& light : lights) pointers.push_back(&light);
    return pointers;
  }

  Sorted sorted() const { return options_.shadows != Shadows::off && !method_.estimates() ? Sorted::for_rays_and_edges : Sorted::for_rays; }

  // The picture's lights: rays that stand for shadows in a limited time would take the faces of closed meshes one by one.
  std::vector<PackLight> own_lights() const {
    std::vector<PackLight> lights = prepare_lights(scene_, surfaces_.environment_spots());
    const bool by_outline = options_.shadows == Shadows::on && !method_.estimates() && !(options_.time_limit > 0);
    return by_outline ? with_solids(std::move(lights), scene_) : lights;
  }

  std::unique_ptr<ManyLightPass> prepare_many_lights() {
    constexpr std::size_t kMany = 64;  // from this many on, automatic uses the tree
    const bool wanted = options_.lights == LightSum::tree || (options_.lights == LightSum::automatic && lights_.size() >= kMany);
    if (!wanted || method_.estimates()) return nullptr;
    return std::make_unique<ManyLightPass>(lights_, surfaces_.camera().origin(), static_cast<float>(options_.light_error));
  }

  const environment::EnvironmentLight* environment() const { return surfaces_.environment(); }
  int tile_count() const { return surfaces_.tile_count(); }
  TileArea area(int index) const { return surfaces_.area(index); }

  // Begins a new state, or checks one that is to be continued.
  void begin(RenderState& state) const {
    const auto tiles = static_cast<std::size_t>(tile_count());
    Picture& picture = state.picture;
    if (state.done.empty()) {
      picture = Picture(options_.width, options_.height);
      state.done.assign(tiles, 0);
      for (int index = 0; index < tile_count(); ++index)
        if (!options_.part.holds(area(index).x, area(index).y, options_.width)) state.done[static_cast<std::size_t>(index)] = 1;
      if (method_.estimates()) picture.layers["variance"].resize(picture.pixels.size());
      const bool has_direct = of_ == LightOf::all_ways;
      if (has_direct && many_lights_) picture.layers["light_bound"].resize(picture.pixels.size());
      if (has_direct && (is_limited() || lighting_.bounds_shadows())) picture.layers["shadow_bound"].resize(picture.pixels.size());
      if (options_.bounces != 0 && !method_.estimates()) AllLight::begin(picture, options_);
    }
    if (state.done.size() != tiles || picture.width != options_.width || picture.height != options_.height ||
        (picture.layers.count("variance") != 0) != method_.estimates())
      throw Error("state", "is of another picture", "go on with the options that it was begun with");
  }

  // Hands the surfaces of a tile whose direct light is done to the bounce.
  void take_surfaces(int index) {
    if (!indirect_) return;
    surfaces_.fill(index, 0, *workspace());
    indirect_->take(*workspace(), area(index));
  }

  template <class Work>
  void each_tile(Work work) {
    arena_.execute([&] {
      tbb::parallel_for(0, tile_count(), [&](int index) {
        if (stopped()) return;
        const FlushDenormals flush;
        work(index);
        if (options_.progress) options_.progress(++done_, steps_);
      });
    });
  }

  // Calls work(tiles) for squares of tiles.
  template <class Work>
  void each_block(Work work) {
    constexpr int kSide = PicturePart::kSide / kTileSide;
    const int across = surfaces_.tiles_across(), down = tile_count() / std::max(across, 1);
    const int blocks_across = (across + kSide - 1) / kSide, blocks_down = (down + kSide - 1) / kSide;
    arena_.execute([&] {
      tbb::parallel_for(0, blocks_across * blocks_down, [&](int block) {
        if (stopped()) return;
        const FlushDenormals flush;
        std::vector<int> tiles;
        const int x = block % blocks_across * kSide, y = block / blocks_across * kSide;
        for (int j = y; j < std::min(y + kSide, down); ++j)
          for (int i = x; i < std::min(x + kSide, across); ++i) tiles.push_back(j * across + i);
        work(tiles);
        for (std::size_t k = 0; k < tiles.size() && options_.progress; ++k) options_.progress(++done_, steps_);
      });
    });
  }

  // Purpose of a surface's samples: primary sample, layer of surfaces that light passes, pilot run (1) or picture (0).
  struct Purpose {
    int sample, layer;
    std::uint64_t phase;
  };

  // One stream of random numbers per pixel and purpose, so that no result depends on the order of the work.
  reference::Random random_of(TileArea a, int x, int y, Purpose purpose) const {
    const auto pixel =
        static_cast<std::uint64_t>(a.y + y) * static_cast<std::uint64_t>(options_.width) + static_cast<std::uint64_t>(a.x + x);
    const auto sample = pixel * static_cast<std::uint64_t>(options_.aa) + static_cast<std::uint64_t>(purpose.sample);
    return reference::Random(options_.seed + (static_cast<std::uint64_t>(purpose.layer) << 32), sample * 2 + purpose.phase);
  }

  template <class Use>  // use(x, y, slot, estimate) for every pixel with a surface
  void estimate_tile(const SurfaceTile& tile, TileArea a, Purpose purpose, int pairs, Use use) {
    DirectSampler& sampler = *samplers_.local();
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        const std::size_t slot = tile_slot(x, y);
        if (tile.material[slot] == nullptr || stopped()) continue;
        reference::Random random = random_of(a, x, y, purpose);
        const Vec3f view{tile.view.x[slot], tile.view.y[slot], tile.view.z[slot]};
        const Surface surface = surface_in(tile, slot);
        Estimate e = sampler.estimate(surface, view, method_.estimated_lobes, pairs, random);
        const PathScene in{scene_, surfaces_.rays(), sampler};
        if (options_.bounces != 0) e += trace_paths(in, surface, view, options_.bounces, pairs, random);
        if (surfaces_.passed_rays().is_random(surface))
          e += trace_through(in, surfaces_.passed_rays(), surface, view, get(tile.passes, slot), options_.bounces, pairs, random);
        use(x, y, slot, e);
      }
  }

  // Each thread has its own tile: fresh memory from the system for every tile would cost more than its rays.
  SurfaceTile* workspace() { return tiles_.local().get(); }

  // Plans pairs per tile by a pilot run. The rms standard error becomes the target's fraction of the rms radiance.
  std::vector<int> plan_pairs() {
    steps_ *= 2;
    std::vector<Pilot> pilots(static_cast<std::size_t>(tile_count()));
    each_tile([&](int index) {
      SurfaceTile* tile = workspace();
      surfaces_.fill(index, 0, *tile);
      Pilot& pilot = pilots[static_cast<std::size_t>(index)];
      sampling_clock_.run([&] {
        estimate_tile(*tile, area(index), {0, 0, 1}, kPilotPairs, [&](int, int, std::size_t, const Estimate& e) {
          pilot.variance += (e.variance.x + e.variance.y + e.variance.z) * kPilotPairs;
          pilot.square += dot(e.mean, e.mean);
        });
      });
    });
    double square = 0, sigma = 0;
    for (const Pilot& pilot : pilots) {
      square += pilot.square;
      sigma += std::sqrt(pilot.variance);
    }
    // Least work for a given sum of variances over pairs: pairs are proportional to the tile's standard deviation.
    std::vector<int> pairs;
    for (const Pilot& pilot : pilots) {
      const double wanted = options_.target_error * options_.target_error * square * options_.aa;
      const double n = wanted > 0 ? std::sqrt(pilot.variance) * sigma / wanted : 0;
      pairs.push_back(static_cast<int>(std::clamp(std::ceil(n), double{kMinPairs}, double{kMaxPairs})));
    }
    return pairs;
  }

  // True if blocks of tiles are lit together.
  bool in_blocks() const { return of_ == LightOf::all_ways && many_lights_ && !lighting_.has_shadows() && method_.exact_diffuse; }

  // Adds all light of a tile except many lights' diffuse light, which its block adds. Returns false if there is no such light.
  bool light_tile_of_block(SurfaceTile& tile, TileArea a) {
    if (tile.any_diffuse) block_clock_.run([&] { many_lights_->take(tile, a, options_.width); });
    const bool diffuse_alone = !(tile.any_specular || tile.any_sheen || tile.any_coat || tile.any_override);
    if (diffuse_alone && many_lights_->serves_all()) return false;
    const auto reaching = lights_reaching(light_pointers_, tile);
    many_lights_->bound() = {};
    if (!reaching.lights.empty()) lighting_.add_beside_block(tile, reaching.lights);
    return true;
  }

  // Adds the direct light of surfaces that are not those of the picture's tiles, whose bound it leaves as it is.
  void light_directly(SurfaceTile& tile, ReceiverKind receiver) {
    TileVector bound;
    if (many_lights_) bound = std::exchange(many_lights_->bound(), {});
    const std::size_t rays = radiosity::fineness_of(options_).shadow_rays;
    if (faces_ != nullptr && receiver == ReceiverKind::patch && rays > 0)
      DirectLight{faces_->lighting, faces_->tinted, surfaces_, faces_->pointers, rays}.add(tile, receiver, *estimates_.local());
    else
      DirectLight{lighting_, tinted_, surfaces_, light_pointers_, rays}.add(tile, receiver, *estimates_.local());
    if (many_lights_) many_lights_->bound() = bound;
  }

  // Solves the light between surfaces, unless the cache holds it. The sum of many lights depends on the camera, so it is not kept.
  void solve_bounces() {
    const auto start = Clock::now();
    if (options_.bound) certificate::BounceBounds::check(scene_, options_);
    const auto solve = [&](std::shared_ptr<const radiosity::PatchLinks>& links) { return solve_patches(&links); };
    std::shared_ptr<const radiosity::PatchLight> patches;
    if (cache_ != nullptr && !many_lights_) {
      std::shared_ptr<radiosity::KeptPatches>& kept = cache_->parts().patches;
      if (kept == nullptr) kept = std::make_shared<radiosity::KeptPatches>();
      patches = kept->light(scene_, options_, solve);
    } else {
      patches = solve_patches(nullptr);
    }
    patches_ms_ = ms_since(start);
    std::unique_ptr<const certificate::BounceBounds> bounds;
    if (options_.bound) {
      steps_ += certificate::BounceBounds::steps(scene_, options_);
      arena_.execute([&] {
        bounds = std::make_unique<const certificate::BounceBounds>(scene_, surfaces_.rays(), options_, [this] {
          if (options_.progress) options_.progress(++done_, steps_);
        });
      });
    }
    all_light_ = std::make_unique<AllLight>(std::move(patches), std::move(bounds), surfaces_, options_,
                                            [this](SurfaceTile& tile) { light_directly(tile, ReceiverKind::asked); });
  }

  std::shared_ptr<const radiosity::PatchLight> solve_patches(std::shared_ptr<const radiosity::PatchLinks>* links) {
    radiosity::PatchOptions wanted{options_.bounces, radiosity::fineness_of(options_), options_.stop};
    const std::uint64_t solve_steps = radiosity::solve_tiles(scene_, wanted);
    steps_ += solve_steps;
    if (options_.progress)
      wanted.progress = [this, solve_steps](double fraction) {
        const auto wanted_steps = static_cast<std::uint64_t>(fraction * static_cast<double>(solve_steps));
        std::uint64_t before = done_;
        while (before < wanted_steps && !done_.compare_exchange_weak(before, wanted_steps)) {
        }
        if (before < wanted_steps) options_.progress(wanted_steps, steps_);
      };
    const auto add_direct = [this](SurfaceTile& tile) {
      if (tile.any_surface) light_directly(tile, ReceiverKind::patch);
    };
    const auto find_incident = [this](const Surface& surface, std::uint64_t number, std::vector<IncidentLight>& found) {
      find_incident_on_patch(*samplers_.local(), environment() != nullptr, surface, number, found);
    };
    return arena_.execute([&] {
      return std::make_shared<const radiosity::PatchLight>(
          radiosity::solve_patches(scene_, surfaces_.rays(), *parts_.maps, wanted, add_direct, find_incident, links));
    });
  }

  // True if the time is limited. Only shadows of direct light take much of it that something else can stand for.
  bool is_limited() const { return options_.time_limit > 0 && options_.bounces == 0 && lighting_.has_shadows() && !in_blocks(); }

  void render_within_limit(RenderState& state) {
    steps_ = static_cast<std::uint64_t>(2 * tile_count());
    TimedPicture timed(state.picture, options_.time_limit,
                       {tile_count(), [this](int index) { return area(index); },
                        [this](int index, ShadowWork work, Picture& to) { return render_tile(index, 0, to, work); },
                        [this] { return ms_since(start_) * 1e-3; }, [this] { return stopped(); },
                        [this] {
                          if (options_.progress) options_.progress(++done_, steps_);
                        }});
    lighting_.give_up_when([this] { return ms_since(start_) * 1e-3 >= options_.time_limit; });
    arena_.execute([&] { timed.render(threads_); });
    exact_tiles_ = timed.exact_tiles();
    estimated_error_ = timed.estimated_error();
    std::fill(state.done.begin(), state.done.end(), 1);
  }

  enum class Sum { tile, block };
  // Computes the light that a tile's surfaces send to the camera, in the tile's radiance. The fraction `shares` of it arrives.
  // Returns the sum of the squares of the errors that rays have estimated.
  double light_tile(SurfaceTile& tile, int index, int sample, int layer, int pairs, const TileVector* shares, Picture& picture, Sum sum,
                    ShadowWork work) {
    const TileArea a = area(index);
    EstimatedShadows* estimate = nullptr;
    const float weight = 1.0f / static_cast<float>(options_.aa);
    if (of_ == LightOf::bounces) {
      tile.radiance = {};
      all_light_->add(tile, {a, sample, layer, shares, weight}, picture);
      add_to_picture(tile.radiance, a, shares, weight, picture.pixels, options_.width);
      return 0;
    }
    bool bounded = many_lights_ != nullptr;
    if (sum == Sum::block) {
      bounded = light_tile_of_block(tile, a);
    } else {
      if (bounded) many_lights_->bound() = {};
      const auto reaching = lights_reaching(light_pointers_, tile);
      if (work.by == ShadowsBy::rays) {
        const std::size_t rays = std::max(work.rays / static_cast<std::size_t>(options_.aa), std::size_t{2});
        estimate = estimates_.local().get();
        estimate->clear();
        tinted_.add(tile, lighting_,
                    [&](TileLighting& past) { past.add_shadowed_by_rays(tile, reaching.lights, rays, sample, *estimate); });
      } else if (lighting_.has_shadows() && work.by == ShadowsBy::edges) {
        if (lighting_.may_estimate()) {
          estimate = estimates_.local().get();
          estimate->clear();
        }
        tinted_.add(tile, lighting_, [&](TileLighting& past) { past.add_shadowed(tile, reaching.lights, sample, estimate); });
      } else {
        lighting_.add(tile, reaching.lights);
      }
    }
    if (!method_.estimates()) surfaces_.add_environment(index, sample, tile);
    if (all_light_) all_light_->add(tile, {a, sample, layer, shares, weight}, picture);
    if (method_.estimates())
      sampling_clock_.run([&] {
        std::vector<Vec3f>& variance = picture.layers.at("variance");
        estimate_tile(tile, a, {sample, layer, 0}, pairs, [&](int x, int y, std::size_t slot, const Estimate& e) {
          tile.radiance.x[slot] += static_cast<float>(e.mean.x);
          tile.radiance.y[slot] += static_cast<float>(e.mean.y);
          tile.radiance.z[slot] += static_cast<float>(e.mean.z);
          const auto pixel =
              static_cast<std::size_t>(a.y + y) * static_cast<std::size_t>(options_.width) + static_cast<std::size_t>(a.x + x);
          const Vec3f share = shares != nullptr ? Vec3f{shares->x[slot], shares->y[slot], shares->z[slot]} : Vec3f{1, 1, 1};
          variance[pixel] += static_cast<Vec3f>(e.variance) * share * share * (weight * weight);
        });
      });
    add_to_picture(tile.radiance, a, shares, weight, picture.pixels, options_.width);
    if (bounded) add_to_picture(many_lights_->bound(), a, shares, weight, picture.layers.at("light_bound"), options_.width);
    if (work.by == ShadowsBy::nothing) {  // all of the light may be missing
      add_to_picture(tile.radiance, a, shares, weight, picture.layers.at("shadow_bound"), options_.width);
      double squares = 0;
      for (std::size_t i = 0; i < kTilePixels; ++i)
        if (tile.material[i] != nullptr) squares += std::pow(luminance(static_cast<Vec3d>(get(tile.radiance, i) * weight)), 2);
      return squares;
    }
    if (estimate == nullptr) return 0;
    add_to_picture(estimate->bound, a, shares, weight, picture.layers.at("shadow_bound"), options_.width);
    if (work.by == ShadowsBy::edges) return 0;
    return estimate->squares * static_cast<double>(weight * weight);
  }

  // Returns the sum of the squares of the estimated errors over the pixels.
  double render_tile(int index, int pairs, Picture& picture, ShadowWork work) {
    double squares = 0;
    for (int s = 0; s < options_.aa; ++s) squares += render_sample(index, s, pairs, picture, Sum::tile, work);
    return squares;
  }

  void render_block(const std::vector<int>& tiles, Picture& picture) {
    for (int s = 0; s < options_.aa; ++s) {
      many_lights_->clear_block();
      for (const int index : tiles) render_sample(index, s, 0, picture, Sum::block, {});
      block_clock_.run([&] { many_lights_->add_block(1.0f / static_cast<float>(options_.aa), picture); });
    }
  }

  // Renders one primary sample of a tile's pixels. Returns the sum of the squares of the estimated errors.
  double render_sample(int index, int s, int pairs, Picture& picture, Sum sum, ShadowWork work) {
    SurfaceTile* tile = workspace();
    const TileArea a = area(index);
    const TilePlane distances = surfaces_.fill(index, s, *tile);
    if (indirect_ && s == 0) capture_clock_.run([&] { indirect_->take(*tile, a); });
    double squares = light_tile(*tile, index, s, 0, pairs, nullptr, picture, sum, work);
    if (!tile->any_passing) return squares;
    const auto ways = std::make_unique<PassedRays::Ways>();
    PassedRays::begin(distances, *ways);
    while (surfaces_.passed_rays().go_on(*tile, *ways)) {
      surfaces_.fill_behind(index, s, *tile, *ways);
      squares += light_tile(*tile, index, s, ways->turn, pairs, &ways->shares, picture, Sum::tile, work);
    }
    return squares;
  }

  const Clock::time_point start_ = Clock::now();
  const Scene& scene_;
  const RenderOptions& options_;
  const LightOf of_;
  const int threads_;
  const DirectMethod method_;
  RenderCache* const cache_;  // null: none
  const SceneParts parts_;
  FrameSurfaces surfaces_;
  const std::vector<PackLight> lights_;
  const std::vector<const PackLight*> light_pointers_ = pointers_to(lights_);
  const std::unique_ptr<ManyLightPass> many_lights_;  // null if each light is summed by itself
  TileLighting lighting_;
  const TintedShadows tinted_;
  std::unique_ptr<FaceLights> faces_;  // of patches; null: the picture's lights are flat or round
  tbb::enumerable_thread_specific<std::unique_ptr<DirectSampler>> samplers_;
  tbb::enumerable_thread_specific<std::unique_ptr<SurfaceTile>> tiles_{[] { return std::make_unique<SurfaceTile>(); }};
  tbb::enumerable_thread_specific<std::unique_ptr<EstimatedShadows>> estimates_{[] { return std::make_unique<EstimatedShadows>(); }};
  tbb::task_arena arena_;
  std::optional<indirect::Pipeline> indirect_;
  std::unique_ptr<AllLight> all_light_;  // null: direct light only
  double build_ms_ = 0, patches_ms_ = 0;
  PassClock sampling_clock_{"sampling"}, block_clock_{"block"}, capture_clock_{"indirect: surfaces"};
  std::atomic<std::uint64_t> done_{0};
  std::uint64_t steps_ = 0;
  double exact_tiles_ = 1, estimated_error_ = 0;  // RenderStats
};

}  // namespace

Picture render_on_cpu(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state,
                      LightOf of) {
  Renderer renderer(scene, options, cache, of);
  RenderState own;
  RenderState& kept = state != nullptr ? *state : own;
  Picture picture = renderer.render(kept);
  kept.complete = !renderer.stopped();
  if (stats != nullptr) renderer.report(*stats, picture);
  if (const auto layer = picture.layers.find("light_bound"); stats != nullptr && layer != picture.layers.end()) {
    double sum = 0;
    for (const Vec3f& bound : layer->second) {
      stats->light_bound_max = std::max(stats->light_bound_max, static_cast<double>(std::max({bound.x, bound.y, bound.z})));
      sum += static_cast<double>(bound.x + bound.y + bound.z) / 3;
    }
    stats->light_bound_mean = sum / static_cast<double>(std::max<std::size_t>(layer->second.size(), 1));
  }
  return picture;
}

}  // namespace steradian
