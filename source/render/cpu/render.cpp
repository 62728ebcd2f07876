#include "render/cpu/render.h"

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

#include "core/float_mode.h"
#include "render/indirect/pipeline.h"
#include "render/cpu/direct.h"
#include "render/cpu/frame_surfaces.h"
#include "render/cpu/gbuffer.h"
#include "render/cpu/methods.h"
#include "render/cpu/monte_carlo.h"
#include "render/cpu/pass_clock.h"
#include "render/cpu/shadow_pass.h"
#include "render/cpu/specular.h"
#include "render/cpu/textured_diffuse.h"
#include "render/lights/many_lights.h"
#include "steradian/error.h"

namespace steradian {
namespace {

// What a pilot run of `reference` says of a tile.
struct Pilot {
  double variance = 0;  // of one pair of samples, summed over pixels and channels
  double square = 0;    // of the radiance, likewise
};

constexpr int kPilotPairs = 32;  // enough to rank tiles; the final estimate does not use them
constexpr int kMinPairs = 64;    // below, the estimated variance is too rough for a z-test
constexpr int kMaxPairs = 1 << 16;

// Shadows of a tile in work, and their thread's memory.
struct ShadowWork {
  TileShadow shadow;
  ShadowCounts counts;
  PackLight pieces;                  // what slots see of a light
  std::vector<std::uint32_t> slots;  // in `some`, side by side
  SurfaceTile some;
  SurfaceTile coats;                 // that have a normal of their own
  std::size_t filled = kTilePixels;  // slots of `some` that may hold a surface
};

class Renderer {
 public:
  Renderer(const Scene& scene, const RenderOptions& options)
      : scene_(scene),
        options_(options),
        threads_(options.threads > 0 ? options.threads : tbb::info::default_concurrency()),
        method_(choose_method(scene, options)),
        surfaces_(scene, options),
        lights_(prepare_lights(scene, surfaces_.environment_spots())),
        many_lights_(prepare_many_lights()),
        direct_(direct_table_for(active_simd())),
        specular_(method_, options.table),
        samplers_([this] {
          return std::make_unique<DirectSampler>(scene_, options_.shadows != Shadows::off ? &surfaces_.rays() : nullptr,
                                                 environment() != nullptr ? &environment()->sampler() : nullptr, options_.terminator);
        }),
        arena_(threads_) {
    if (options.shadows != Shadows::off && !method_.estimates()) shadows_.emplace(scene_, lights_, surfaces_.rays(), options.shadows);
    if (options.indirect.mode != IndirectMode::off) indirect_.emplace(scene_, surfaces_.rays(), options_, threads_);
    build_ms_ = ms_since(start_);
  }

  Picture render(RenderState& state) {
    begin(state);
    std::vector<int> pairs(state.done.size(), options_.spp);
    steps_ = static_cast<std::uint64_t>(tile_count());
    if (method_.kind == MethodKind::reference) pairs = plan_pairs();
    each_tile([&](int index) {
      const auto tile = static_cast<std::size_t>(index);
      if (state.done[tile] != 0) return take_surfaces(index);
      render_tile(index, pairs[tile], state.picture);
      // Asked to stop on its way, it has left out samples: what it has is of no use.
      stopped() ? clear_tile(index, state.picture) : void(state.done[tile] = 1);
    });
    Picture picture = options_.stop != nullptr ? state.picture : std::move(state.picture);  // who cannot stop it needs no copy
    if (indirect_ && !stopped()) arena_.execute([&] { indirect_->add_to(picture); });
    return picture;
  }

  bool stopped() const { return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed); }

  void report(RenderStats& stats) const {
    stats.passes = {{"build", build_ms_},
                    surfaces_.rays_time(threads_),
                    surfaces_.gbuffer_time(threads_),
                    direct_clock_.time(threads_),
                    specular_clock_.time(threads_)};
    if (method_.estimates()) stats.passes.push_back(sampling_clock_.time(threads_));
    if (environment() != nullptr) {
      stats.passes.front().ms -= surfaces_.environment_build_ms();
      stats.passes.push_back({"environment: maps", surfaces_.environment_build_ms()});
      stats.passes.push_back(surfaces_.environment_time(threads_));
      stats.environment_spots = environment()->share_of_spots();
      stats.diffuse_residual = environment()->diffuse_residual();
    }
    if (many_lights_) {
      stats.light_tree = true;
      lights::Counts all;
      for (const auto& work : light_work_) all += lights::ManyLights::counts(*work);
      const double points = std::max(static_cast<double>(all.points), 1.0);
      stats.light_elements = static_cast<double>(all.elements) / points;
      stats.light_outlines = static_cast<double>(all.outlines) / points;
    }
    if (shadows_) {
      stats.passes.push_back(shadow_clock_.time(threads_));
      ShadowCounts counts;
      for (const auto& work : shadow_work_) {
        counts.points += work->counts.points;
        counts.fallback += work->counts.fallback;
      }
      if (counts.points > 0) stats.shadow_fallback = static_cast<double>(counts.fallback) / static_cast<double>(counts.points);
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

  std::unique_ptr<const lights::ManyLights> prepare_many_lights() {
    constexpr std::size_t kMany = 64;  // from here on automatic takes the tree
    const bool wanted = options_.lights == LightSum::tree || (options_.lights == LightSum::automatic && lights_.size() >= kMany);
    if (!wanted || method_.estimates()) return nullptr;
    return std::make_unique<const lights::ManyLights>(lights_, surfaces_.camera().origin(), static_cast<float>(options_.light_error));
  }

  const environment::EnvironmentLight* environment() const { return surfaces_.environment(); }
  int tile_count() const { return surfaces_.tile_count(); }
  TileArea area(int index) const { return surfaces_.area(index); }

  // A new state, or one to go on with.
  void begin(RenderState& state) const {
    const auto tiles = static_cast<std::size_t>(tile_count());
    Picture& picture = state.picture;
    if (state.done.empty()) {
      picture = Picture(options_.width, options_.height);
      state.done.assign(tiles, 0);
      if (method_.estimates()) picture.layers["variance"].resize(picture.pixels.size());
      if (many_lights_) picture.layers["light_bound"].resize(picture.pixels.size());
    }
    if (state.done.size() != tiles || picture.width != options_.width || picture.height != options_.height ||
        (picture.layers.count("variance") != 0) != method_.estimates())
      throw Error("state", "is of another picture", "go on with the options that it was begun with");
  }

  void clear_tile(int index, Picture& picture) const {
    const TileArea a = area(index);
    const auto clear = [&](std::vector<Vec3f>& pixels) {
      for (int y = a.y; y < a.y + a.height; ++y) {
        const auto row = static_cast<std::ptrdiff_t>(y) * options_.width + a.x;
        std::fill_n(pixels.begin() + row, a.width, Vec3f{});
      }
    };
    clear(picture.pixels);
    for (auto& [name, layer] : picture.layers) clear(layer);
  }

  // Of a tile whose direct light is done: what the bounce wants of it.
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

  // What a surface's samples are for: primary sample, layer of surfaces that light passes, pilot run (1) or picture (0).
  struct Purpose {
    int sample, layer;
    std::uint64_t phase;
  };

  // One stream of random numbers per pixel and purpose: no result depends on who computes what.
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
        use(x, y, slot, sampler.estimate(surface_in(tile, slot), view, method_.estimated_lobes, pairs, random));
      }
  }

  // A thread's own: memory fresh from the system for every tile would cost more than its rays.
  SurfaceTile* workspace() { return tiles_.local().get(); }

  // Pairs per tile so that the rms standard error is the target's share of the rms radiance, from a pilot run.
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
    // Least work for a given sum of variances over pairs: pairs in proportion to the tile's standard deviation.
    std::vector<int> pairs;
    for (const Pilot& pilot : pilots) {
      const double wanted = options_.target_error * options_.target_error * square * options_.aa;
      const double n = wanted > 0 ? std::sqrt(pilot.variance) * sigma / wanted : 0;
      pairs.push_back(static_cast<int>(std::clamp(std::ceil(n), double{kMinPairs}, double{kMaxPairs})));
    }
    return pairs;
  }

  // The same of many lights, the diffuse light of those far off together.
  void add_many_lights(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
    if (method_.exact_diffuse && tile.any_diffuse)
      direct_clock_.run([&] {
        std::vector<const PackLight*> together, plain;
        for (const PackLight* light : lights) (many_lights_->serves(*light) ? together : plain).push_back(light);
        many_lights_->add_diffuse(tile, together, *light_bounds_.local(), *light_work_.local());
        const std::vector<const PackLight*> untextured = without_textured(plain);
        if (!untextured.empty()) direct_.add_diffuse(tile, untextured.data(), untextured.size());
        if (untextured.size() < plain.size()) add_diffuse_from_textured(tile, plain);
      });
    const SpecularPass::Far far = {many_lights_->lights(), many_lights_->error(), *light_bounds_.local()};
    specular_clock_.run([&] { specular_.add(tile, lights, SpecularPass::Walk::specular_alone, &far); });
  }

  // What the lights send without sampling, nothing between.
  void add_light(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
    constexpr std::size_t kFew = 8;  // are done before cells are
    if (many_lights_ && lights.size() > kFew) return add_many_lights(tile, lights);
    if (method_.exact_diffuse && tile.any_diffuse)
      direct_clock_.run([&] {
        std::vector<const PackLight*> plain = without_textured(lights);
        if (!method_.estimates()) std::erase_if(plain, [&](const PackLight* light) { return specular_.brings_diffuse(tile, *light); });
        if (!plain.empty()) direct_.add_diffuse(tile, plain.data(), plain.size());
        if (plain.size() < lights.size()) add_diffuse_from_textured(tile, lights);
      });
    if (!method_.estimates()) specular_clock_.run([&] { specular_.add(tile, lights); });
  }

  // The light of a tile past what blocks it. A light before which nothing stands goes the usual way; of the others, the slots that see
  // all of it or a part are evaluated side by side.
  void add_shadowed(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
    if (lights.empty()) return;
    ShadowWork& work = *shadow_work_.local();
    const bool coats = tile.any_coat && take_coats(tile, work.coats);
    add_past_blockers(tile, lights, work);
    if (!coats) return;
    add_past_blockers(work.coats, lights, work);
    put_back_coats(work.coats, tile);
  }

  void add_past_blockers(SurfaceTile& tile, const std::vector<const PackLight*>& lights, ShadowWork& work) {
    TilePoints points;
    shadow_clock_.run([&] { points = points_for_shadows(tile, options_.terminator); });
    std::vector<const PackLight*> plain;
    for (const PackLight* light : lights) {
      shadow_clock_.run([&] { shadows_->find(tile, points, *light, work.shadow, work.counts); });
      if (work.shadow.is_plain()) {
        plain.push_back(light);
        continue;
      }
      add_whole(tile, *light, work);
      add_parts(tile, *light, work);
    }
    if (!plain.empty()) add_light(tile, plain);
  }

  // Slots that see all of a light, or a share of it.
  void add_whole(SurfaceTile& tile, const PackLight& light, ShadowWork& work) {
    using Seen = TileShadow::Seen;
    work.slots.clear();
    for (std::uint32_t i = 0; i < kTilePixels; ++i)
      if (work.shadow.seen[i] == Seen::whole || work.shadow.seen[i] == Seen::share) work.slots.push_back(i);
    if (work.slots.empty()) return;
    SurfaceTile& some = light_slots(tile, light, work);
    for (std::size_t k = 0; k < work.slots.size(); ++k) {
      const std::uint32_t i = work.slots[k];
      add_radiance(tile, i, radiance_in(some, k) * (work.shadow.seen[i] == Seen::share ? work.shadow.share[i] : 1.0f));
    }
  }

  // The radiance that a light sends to some slots alone, in their order.
  SurfaceTile& light_slots(const SurfaceTile& tile, const PackLight& light, ShadowWork& work) {
    work.filled = take_slots(tile, work.slots, work.filled, work.some);
    // Pieces lie above the surface's horizon, and no coat's normal differs from it by more than rounding (take_coats).
    if (light.is_pieces()) work.some.coat_normal = work.some.normal;
    add_light(work.some, {&light});
    return work.some;
  }

  static Vec3f radiance_in(const SurfaceTile& tile, std::size_t i) { return {tile.radiance.x[i], tile.radiance.y[i], tile.radiance.z[i]}; }
  static void add_radiance(SurfaceTile& tile, std::size_t i, Vec3f r) {
    tile.radiance.x[i] += r.x;
    tile.radiance.y[i] += r.y;
    tile.radiance.z[i] += r.z;
  }

  // Slots that see a part of a light.
  void add_parts(SurfaceTile& tile, const PackLight& light, ShadowWork& work) {
    for (std::size_t i = 0; i < work.shadow.batch_count; ++i) add_batch(tile, light, work.shadow.batches[i], work);
  }

  void add_batch(SurfaceTile& tile, const PackLight& light, TileShadow::Batch& batch, ShadowWork& work) {
    work.slots = batch.slots;
    const std::size_t count = batch.slots.size();
    std::vector<Vec3f> radiance(count);
    work.pieces.radiance = light.radiance;
    light_pieces(tile, batch.visible, work, [&](const SurfaceTile& seen) {
      for (std::size_t k = 0; k < count; ++k) radiance[k] = radiance_in(seen, k) * batch.passes[k];
    });
    if (batch.all.point_count() > 0) {
      // The polygon stands for the light only in what share of it arrives: no step where shadows begin.
      const auto over = [](float part, float all) { return all > 0 ? part / all : 0.0f; };
      light_pieces(tile, batch.all, work, [&](const SurfaceTile& all) {
        for (std::size_t k = 0; k < count; ++k) {
          const Vec3f a = radiance_in(all, k);
          radiance[k] = {over(radiance[k].x, a.x), over(radiance[k].y, a.y), over(radiance[k].z, a.z)};
        }
      });
      const SurfaceTile& whole = light_slots(tile, light, work);
      for (std::size_t k = 0; k < count; ++k) radiance[k] = radiance[k] * radiance_in(whole, k);
    }
    for (std::size_t k = 0; k < count; ++k)
      if (batch.slots[k] != kNoSlot) add_radiance(tile, batch.slots[k], radiance[k]);
  }

  // use(tile): the radiance that some slots get from pieces, in their order.
  template <class Use>
  void light_pieces(const SurfaceTile& tile, packed::Pieces& pieces, ShadowWork& work, Use use) {
    if (!work.pieces.is_pieces()) work.pieces.shape = packed::Pieces();
    std::swap(std::get<packed::Pieces>(work.pieces.shape), pieces);
    use(light_slots(tile, work.pieces, work));
    std::swap(std::get<packed::Pieces>(work.pieces.shape), pieces);
  }

  // What the surfaces of a tile send to the camera, in its radiance; `shares` of it arrive.
  void light_tile(SurfaceTile& tile, TileArea a, int sample, int layer, int pairs, const TileVector* shares, Picture& picture) {
    const float weight = 1.0f / static_cast<float>(options_.aa);
    TileVector* bounds = many_lights_ ? light_bounds_.local().get() : nullptr;
    std::vector<Vec3f>* bound_layer = many_lights_ ? &picture.layers.at("light_bound") : nullptr;
    if (bounds != nullptr) *bounds = {};
    const bool diffuse_alone = !(tile.any_specular || tile.any_sheen || tile.any_coat || tile.any_override);
    if (many_lights_ && !shadows_ && diffuse_alone) {
      add_light(tile, light_pointers_);  // it finds out by itself whom they reach
    } else {
      const auto reaching = lights_reaching(light_pointers_, tile);
      if (shadows_) {
        add_shadowed(tile, reaching.lights);
      } else {
        add_light(tile, reaching.lights);
      }
    }
    if (!method_.estimates()) surfaces_.add_environment(tile);
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
    if (bounds != nullptr) add_to_picture(*bounds, a, shares, weight, *bound_layer, options_.width);
  }

  void render_tile(int index, int pairs, Picture& picture) {
    SurfaceTile* tile = workspace();
    const TileArea a = area(index);
    for (int s = 0; s < options_.aa; ++s) {
      TilePlane behind = surfaces_.fill(index, s, *tile);
      if (indirect_ && s == 0) capture_clock_.run([&] { indirect_->take(*tile, a); });
      light_tile(*tile, a, s, 0, pairs, nullptr, picture);
      if (!tile->any_passing) continue;
      TileVector shares;
      for (TilePlane* plane : {&shares.x, &shares.y, &shares.z}) plane->fill(1);
      for (int layer = 1; layer < kMostLayers && tile->any_passing; ++layer) {
        look_through(*tile, shares, behind);
        behind = surfaces_.fill(index, s, *tile, &behind);
        light_tile(*tile, a, s, layer, pairs, &shares, picture);
      }
    }
  }

  const Clock::time_point start_ = Clock::now();
  const Scene& scene_;
  const RenderOptions& options_;
  const int threads_;
  const DirectMethod method_;
  FrameSurfaces surfaces_;
  const std::vector<PackLight> lights_;
  const std::vector<const PackLight*> light_pointers_ = pointers_to(lights_);
  const std::unique_ptr<const lights::ManyLights> many_lights_;  // null where each light is done by itself
  const DirectTable& direct_;
  const SpecularPass specular_;
  tbb::enumerable_thread_specific<std::unique_ptr<DirectSampler>> samplers_;
  tbb::enumerable_thread_specific<std::unique_ptr<SurfaceTile>> tiles_{[] { return std::make_unique<SurfaceTile>(); }};
  tbb::task_arena arena_;
  std::optional<indirect::Pipeline> indirect_;
  std::optional<ShadowPass> shadows_;
  tbb::enumerable_thread_specific<lights::ManyLights::WorkPointer> light_work_{[] { return lights::ManyLights::make_work(); }};
  tbb::enumerable_thread_specific<std::unique_ptr<TileVector>> light_bounds_{[] { return std::make_unique<TileVector>(); }};
  tbb::enumerable_thread_specific<std::unique_ptr<ShadowWork>> shadow_work_{[] { return std::make_unique<ShadowWork>(); }};
  double build_ms_ = 0;
  PassClock direct_clock_{"direct"}, specular_clock_{"specular"}, sampling_clock_{"sampling"}, capture_clock_{"indirect: surfaces"},
      shadow_clock_{"shadows"};
  std::atomic<std::uint64_t> done_{0};
  std::uint64_t steps_ = 0;
};

}  // namespace

Picture render_on_cpu(const Scene& scene, const RenderOptions& options, RenderStats* stats, RenderState* state) {
  Renderer renderer(scene, options);
  RenderState own;
  RenderState& kept = state != nullptr ? *state : own;
  Picture picture = renderer.render(kept);
  kept.complete = !renderer.stopped();
  if (stats != nullptr) renderer.report(*stats);
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
