#include "render/frame/all_light.h"

#include <cmath>
#include <memory>
#include <utility>

#include "steradian/area_light.h"  // luminance

namespace steradian {

namespace {

void add(TileVector& to, std::size_t i, Vec3f r) {
  to.x[i] += r.x;
  to.y[i] += r.y;
  to.z[i] += r.z;
}

}  // namespace

AllLight::AllLight(const Scene& scene, const SceneParts& parts, const FrameSurfaces& surfaces, const RenderOptions& options,
                   const AddDirect& add_to_patches, const radiosity::PatchLight::FindIncident& find_incident, AddDirect add_direct)
    : width_(options.width),
      reflections_(options.reflections),
      eye_(surfaces.camera().origin()),
      patches_([&] {
        const auto start = Clock::now();
        radiosity::PatchLight light(scene, *parts.rays, *parts.maps, {options.bounces, options.quality}, add_to_patches, find_incident);
        solve_ms_ = ms_since(start);
        return light;
      }()),
      gather_(patches_, *parts.rays, options.quality, options.bounce_error, options.aa),
      surfaces_(surfaces),
      add_direct_(std::move(add_direct)) {}

void AllLight::begin(Picture& picture) {
  for (const char* layer : {"indirect", "bounce_error", "bounce_bound"}) picture.layers[layer].resize(picture.pixels.size());
}

// Adds the light that a tile's surfaces gather to `light`.
void AllLight::gather(SurfaceTile& tile, int sample, TileVector& light, TileVector& error) const {
  SixteenSurfaces some;
  for (std::size_t first = 0; first < kTilePixels; first += SixteenSurfaces::kLanes) {
    some.take(tile, first);
    if (some.lit == 0) continue;
    const radiosity::Gather::Result result = gather_.reflected(some, sample);
    for (std::size_t i = 0; i < SixteenSurfaces::kLanes; ++i) {
      steradian::add(light, first + i, result.radiance[i]);
      steradian::add(error, first + i, result.error[i]);
    }
  }
}

// Adds the light of the surfaces that mirrors show, which are lit like those that the camera sees. The lobes' integrals over the lamps
// already hold the lamps' light.
void AllLight::add_mirrored(const SurfaceTile& tile, const TilePlane& distance, int sample, int depth, TileVector& light,
                            TileVector& error) const {
  if (depth == 0) return;
  const auto ways = std::make_unique<PassedRays::Ways>();
  if (!radiosity::find_mirrored(surfaces_.rays(), tile, distance, *ways)) return;
  const auto shown = std::make_unique<SurfaceTile>();
  for (int layer = 0; layer < kMostLayers; ++layer) {
    if (layer > 0) surfaces_.look_through(*shown, *ways);
    clear_kinds(*shown);
    shown->seed = tile.seed;
    for (std::size_t i = 0; i < kTilePixels; ++i) put_nothing(*shown, i);
    surfaces_.passed_rays().fill(*ways, PassedRays::Lamps::hidden, *shown);
    if (!shown->any_surface) return;
    add_direct_(*shown);
    TileVector error_of_shown{};
    gather(*shown, sample, shown->radiance, error_of_shown);
    TilePlane onwards;
    for (std::size_t i = 0; i < kTilePixels; ++i) onwards[i] = ways->length[i] + length(get(shown->position, i) - get(ways->origin, i));
    add_mirrored(*shown, onwards, sample, depth - 1, shown->radiance, error_of_shown);
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      if (shown->material[i] == nullptr) continue;
      steradian::add(light, i, get(shown->radiance, i) * get(ways->shares, i));
      steradian::add(error, i, get(error_of_shown, i) * get(ways->shares, i));
    }
    if (!shown->any_passing) return;
  }
}

void AllLight::add(SurfaceTile& tile, TileArea area, int sample, const TileVector* shares, float weight, Picture& picture) {
  TileVector light{}, error{};
  clock_.run([&] {
    gather(tile, sample, light, error);
    TilePlane distance;
    for (std::size_t i = 0; i < kTilePixels; ++i) distance[i] = length(get(tile.position, i) - eye_);
    add_mirrored(tile, distance, sample, reflections_, light, error);
    for (std::size_t i = 0; i < kTilePixels; ++i) steradian::add(tile.radiance, i, get(light, i));
  });
  add_to_picture(light, area, shares, weight, picture.layers.at("indirect"), width_);
  add_to_picture(error, area, shares, weight, picture.layers.at("bounce_error"), width_);
  const float left_out = patches_.left_out().value_or(0);
  TileVector bound{};
  for (std::size_t i = 0; i < kTilePixels; ++i)  // no surface reflects more than arrives
    if (tile.material[i] != nullptr) put(bound, i, {left_out, left_out, left_out});
  add_to_picture(bound, area, shares, weight, picture.layers.at("bounce_bound"), width_);
}

void AllLight::report(int threads, RenderStats& stats, const Picture& picture) const {
  stats.passes.push_back({"bounces: patches", solve_ms_});
  stats.passes.push_back(clock_.time(threads));
  stats.patches = patches_.patches().side_count() / 2;
  stats.bounce_iterations = patches_.iterations();
  stats.bounce_left_out = static_cast<double>(patches_.left_out().value_or(-1));
  double squares = 0, light = 0;
  for (const Vec3f& e : picture.layers.at("bounce_error")) squares += std::pow(luminance(static_cast<Vec3d>(e)), 2);
  for (const Vec3f& p : picture.pixels) light += luminance(static_cast<Vec3d>(p));
  const auto count = static_cast<double>(picture.pixels.size());
  stats.bounce_error = light > 0 ? std::sqrt(squares / count) / (light / count) : 0;
}

}  // namespace steradian
