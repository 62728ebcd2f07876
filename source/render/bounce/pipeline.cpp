#include "render/bounce/pipeline.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstring>

#include "core/float_mode.h"
#include "render/bounce/receivers/blue_noise.h"
#include "render/bounce/receivers/filter.h"
#include "render/bounce/receivers/light_receivers.h"
#include "render/bounce/receivers/resolve.h"
#include "render/bounce/true_light.h"
#include "render/sampled/paths.h"

namespace steradian::indirect {
namespace {

using Clock = std::chrono::steady_clock;

// True if ground truth needs the surfaces as their materials describe them.
bool needs_whole_surfaces(const RenderOptions& options) {
  return options.indirect.mode == IndirectMode::path || options.method == "reference";
}

// Places spread over the picture, for the culling's threshold.
VectorArray some_receivers(const PictureSurfaces& s) {
  constexpr int kColumns = 16, kDown = 9;
  VectorArray places(kColumns * kDown);
  std::size_t n = 0;
  for (int j = 0; j < kDown; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const std::size_t at = s.raster.at((2 * i + 1) * s.raster.width / (2 * kColumns), (2 * j + 1) * s.raster.height / (2 * kDown));
      if (dot(s.normal[at], s.normal[at]) > 0) places.put(n++, s.position[at]);
    }
  places.resize(n);
  return places;
}

// Distance between the surfaces of neighbouring pixels: the median over places spread over the picture.
double pixel_spacing(const PictureSurfaces& s) {
  constexpr int kColumns = 32, kDown = 18;
  std::vector<double> spacings;
  for (int j = 0; j < kDown; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const int x = (2 * i + 1) * s.raster.width / (2 * kColumns), y = (2 * j + 1) * s.raster.height / (2 * kDown);
      if (x + 1 >= s.raster.width || y + 1 >= s.raster.height) continue;
      const std::size_t at = s.raster.at(x, y), right = s.raster.at(x + 1, y), below = s.raster.at(x, y + 1);
      const Vec3f n = s.normal[at];
      if (!(dot(n, n) > 0) || !(dot(n, s.normal[right]) > 0.9f) || !(dot(n, s.normal[below]) > 0.9f)) continue;  // a different surface
      spacings.push_back(0.5 *
                         static_cast<double>(length(s.position[right] - s.position[at]) + length(s.position[below] - s.position[at])));
    }
  if (spacings.empty()) return 0;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

// Side of the pattern that suits the picture. The filter joins pixels within four sides, and light must not vary much over that distance.
constexpr double kFilterShare = 0.25;  // fraction of the light's way: that of 1280 pixels across `ring` with the whole pattern
int pattern_side(int wanted, double spacing, double way) {
  int side = wanted;
  while (side > 1 && 4 * side * spacing > kFilterShare * way) side /= 2;
  return side;
}

// Virtual lights that a pixel keeps: as many as a pattern of the wanted side would have joined, limited to the time of a frame at 1080p.
double kept_pairs(const RenderOptions& options, int side) {
  const double joined = static_cast<double>(options.indirect.interleave) / side;
  const double room = 1920.0 * 1080.0 / (static_cast<double>(options.width) * options.height);
  return options.indirect.kept_pairs * std::clamp(room, 1.0, joined * joined);
}

}  // namespace

Pipeline::Pipeline(const Scene& scene, const RayScene& rays, const RenderOptions& options, int threads, Passes* device)
    : scene_(scene),
      rays_(rays),
      options_(options),
      threads_(threads),
      device_(device),
      tables_(ltc_pack_tables(Method::ltc_compact)),
      surfaces_(Raster{options.width, options.height}),
      whole_(needs_whole_surfaces(options) ? surfaces_.raster.size() : 0) {
  blue_noise();  // a table, not part of the frame's time
}

void Pipeline::take(const SurfaceTile& tile, TileArea area) {
  // Copies plane by plane, in the runs of four that a tile's slots and a picture's row have in common.
  const auto copy_plane = [&](const TilePlane& from, FloatArray& to) {
    for (int y = 0; y < area.height; ++y) {
      float* row = &to[surfaces_.raster.at(area.x, area.y + y)];
      int x = 0;
      for (; x + 4 <= area.width; x += 4) std::memcpy(row + x, &from[tile_slot(x, y)], 4 * sizeof(float));
      for (; x < area.width; ++x) row[x] = from[tile_slot(x, y)];
    }
  };
  const auto copy = [&](const TileVector& from, VectorArray& to) {
    copy_plane(from.x, to.x);
    copy_plane(from.y, to.y);
    copy_plane(from.z, to.z);
  };
  if (!tile.any_surface) return;
  copy(tile.position, surfaces_.position);
  copy(tile.normal, surfaces_.normal);
  copy(tile.view, surfaces_.view);
  copy(tile.albedo, surfaces_.albedo);
  copy(tile.f0, surfaces_.f0);
  copy(tile.f90, surfaces_.f90);
  copy_plane(tile.alpha_x, surfaces_.alpha);
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x) {
      const std::size_t slot = tile_slot(x, y), i = surfaces_.raster.at(area.x + x, area.y + y);
      if (tile.alpha_x[slot] != tile.alpha_y[slot]) surfaces_.alpha[i] = std::sqrt(tile.alpha_x[slot] * tile.alpha_y[slot]);
      const bool takes_light =
          tile.material[slot] != nullptr && (weighs(get(tile.albedo, slot)) || weighs(get(tile.f0, slot)) || weighs(get(tile.f90, slot)));
      if (!takes_light) surfaces_.normal.put(i, {0, 0, 0});
      if (!whole_.empty() && tile.material[slot] != nullptr) whole_[i] = surface_in(tile, slot);
    }
}

template <class Work>
auto Pipeline::timed(const char* name, Work work) {
  const auto start = Clock::now();
  auto result = work();
  passes_.push_back({name, std::chrono::duration<double, std::milli>(Clock::now() - start).count()});
  return result;
}

void Pipeline::add_to(Picture& picture) {
  picture.layers["indirect"].resize(picture.pixels.size());
  whole_.empty() ? add_sum(picture) : add_true(picture);
}

void Pipeline::add_sum(Picture& picture) {
  const IndirectOptions& o = options_.indirect;
  const ShadowMap map = timed(
      "shadow map", [&] { return make_shadow_map(scene_, rays_, o.virtual_lights, device_ != nullptr ? device_->first_hits() : nullptr); });
  const LobeArrays lobes = timed("virtual lights", [&] {
    if (device_ != nullptr) return device_->lobes(map);
    LobeArrays result(map.alpha.size());
    virtual_light_table_for(active_simd()).prepare(map, tables_, result);
    return result;
  });
  int side = o.interleave;
  const std::vector<LightSet> sets = timed("ranges", [&] {
    const VectorArray receivers = some_receivers(surfaces_);
    if (o.filter) side = pattern_side(o.interleave, pixel_spacing(surfaces_), travelled(map, lobes, receivers));
    SetOptions set;
    set.mode = o.mode;
    set.stride = side;
    set.threshold = threshold_for(map, lobes, receivers, side, kept_pairs(options_, side));
    set.soften = o.soften;
    set.seed = options_.seed;
    return make_sets(map, lobes, set);
  });
  const Layout layout(options_.width, options_.height, side);
  if (o.filter && side > 1) widen_over_pattern(surfaces_, side);
  if (device_ != nullptr) {
    const VectorArray radiance = timed("device", [&] {
      return device_->radiance(surfaces_, sets, layout, {o.mode, o.quads, o.filter && side > 1});
    });
    for (PassTime& pass : device_->take_times()) passes_.push_back(std::move(pass));
    for (int y = 0; y < options_.height; ++y) add_radiance(radiance, y, picture);
    return;
  }
  Receivers receivers = timed("interleave", [&] { return interleave(surfaces_, layout, o.mode); });
  LightingOptions lighting;
  lighting.mode = o.mode;
  lighting.quads = o.quads;
  lighting.shadows = &rays_;
  lighting.shadow_rays = o.shadow_rays;
  lighting.seed = options_.seed;
  LightingResult lit = light_receivers(sets, receivers, layout, tables_, lighting);
  passes_.push_back({"cull", lit.work.cull_ms / threads_});
  passes_.push_back({"light", lit.work.light_ms / threads_});
  if (o.shadow_rays > 0) passes_.push_back({"shadows", lit.work.shadow_ms / threads_});
  receivers = {};  // frees memory for the next planes
  IncomingLight light = timed("deinterleave", [&] { return deinterleave(lit.light, layout); });
  lit.light = {};
  if (o.filter && side > 1)
    light = timed("filter", [&] {
      FloatArray width(surfaces_.raster.size());
      tbb::parallel_for(std::size_t{0}, width.size() / 16, [&](std::size_t block) {  // a pitch is a multiple of 16
        for (std::size_t i = 16 * block; i < 16 * block + 16; ++i)
          width[i] = surfaces_.f0.x[i] + surfaces_.f0.y[i] + surfaces_.f0.z[i] + surfaces_.f90.x[i] > 0 ? surfaces_.alpha[i] : -1.0f;
      });
      return filter(surfaces_, width, side, light);
    });
  timed("resolve", [&] {
    VectorArray radiance(surfaces_.raster.size());
    tbb::parallel_for(0, options_.height, [&](int y) {
      resolve_table_for(active_simd()).run(surfaces_, light, tables_, y, y + 1, radiance);
      add_radiance(radiance, y, picture);
    });
    return 0;
  });
}

// Adds one row of the bounce's radiance.
void Pipeline::add_radiance(const VectorArray& radiance, int y, Picture& picture) const {
  std::vector<Vec3f>& layer = picture.layers.at("indirect");
  for (int x = 0; x < options_.width; ++x) {
    const Vec3f r = radiance[surfaces_.raster.at(x, y)];
    layer[static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.width) + static_cast<std::size_t>(x)] = r;
    picture.at(x, y) += r;
  }
}

void Pipeline::add_true(Picture& picture) {
  const IndirectOptions& o = options_.indirect;
  const bool path = o.mode == IndirectMode::path;
  const ShadowMap map = path ? ShadowMap{} : make_shadow_map(scene_, rays_, o.virtual_lights);
  SumOptions sum;
  sum.lobe = o.mode == IndirectMode::ggx ? SumLobe::ggx : o.mode == IndirectMode::ltc_outgoing ? SumLobe::ltc_outgoing : SumLobe::ltc;
  sum.shadows = o.shadow_rays > 0 ? &rays_ : nullptr;
  tbb::enumerable_thread_specific<std::unique_ptr<DirectSampler>> samplers([&] { return std::make_unique<DirectSampler>(scene_, &rays_); });
  std::vector<Vec3f>& layer = picture.layers.at("indirect");
  std::vector<Vec3f> variance(picture.pixels.size());
  timed(path ? "paths" : "all virtual lights", [&] {
    tbb::parallel_for(0, options_.width * options_.height, [&](int k) {
      const int x = k % options_.width, y = k / options_.width;
      const std::size_t i = surfaces_.raster.at(x, y), pixel = static_cast<std::size_t>(k);
      const Surface& surface = whole_[i];
      if (surface.material == nullptr || (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed))) return;
      Vec3d radiance;
      if (path) {
        reference::Random random(options_.seed, pixel * 2 + 1);
        const Estimate e = trace_paths({scene_, rays_, *samplers.local()}, surface, surfaces_.view[i], 1, options_.spp, random);
        radiance = e.mean;
        variance[pixel] = static_cast<Vec3f>(e.variance);
      } else {
        radiance = sum_virtual_lights(map, surface, surfaces_.view[i], sum);
      }
      layer[pixel] = static_cast<Vec3f>(radiance);
      picture.pixels[pixel] += static_cast<Vec3f>(radiance);
    });
    return 0;
  });
  if (path) picture.layers["indirect_variance"] = std::move(variance);
}

}  // namespace steradian::indirect
