#include "render/frame/surface_light.h"

#include <algorithm>
#include <numbers>

namespace steradian {
namespace {

std::vector<const PackLight*> all_of(const std::vector<PackLight>& lights) {
  std::vector<const PackLight*> pointers;
  for (const PackLight& light : lights) pointers.push_back(&light);
  return pointers;
}

}  // namespace

void find_incident_on_patch(DirectSampler& sampler, bool has_environment, const Surface& surface, std::uint64_t number,
                            std::vector<IncidentLight>& found) {
  constexpr std::size_t kMostLights = 64, kMostPlaces = 16, kPlaces = 32;
  const std::size_t lights = sampler.light_count() + (has_environment ? 1 : 0);
  if (lights == 0 || lights > kMostLights) return;
  reference::Random random(number);
  sampler.find_incident(surface, static_cast<int>(std::clamp(kPlaces / lights, std::size_t{1}, kMostPlaces)), random, found);
}

FaceLights::FaceLights(const Scene& scene, const RenderOptions& options, const DirectMethod& method, const SceneParts& parts,
                       std::span<const AreaLight> spots)
    : lights(prepare_lights(scene, spots)),
      pointers(all_of(lights)),
      lighting(scene, options, method, lights, parts, nullptr),
      tinted(scene, options, method, lights, nullptr) {}

SurfaceLight::SurfaceLight(const Scene& scene, const RenderOptions& options, const WorkFraction& solved)
    : options_(options),
      method_(choose_method(scene, options)),
      parts_(SceneParts::of(scene, options.shadows != Shadows::off ? Sorted::for_rays_and_edges : Sorted::for_rays)),
      surfaces_(scene, options, parts_, method_.table.get()),
      lights_(scene, options, method_, parts_, surfaces_.environment_spots()),
      estimates_([] { return std::make_unique<EstimatedShadows>(); }),
      samplers_([this, &scene] {
        const environment::EnvironmentLight* around = surfaces_.environment();
        return std::make_unique<DirectSampler>(scene, options_.shadows != Shadows::off ? &surfaces_.rays() : nullptr,
                                               around != nullptr ? &around->sampler() : nullptr, options_.terminator, method_.table.get());
      }) {
  if (options.bounces == 0) return;
  const radiosity::Fineness fineness = radiosity::fineness_of(options);
  patches_ = std::make_unique<const radiosity::PatchLight>(radiosity::solve_patches(
      scene, surfaces_.rays(), *parts_.maps, {options.bounces, fineness, options.stop, solved},
      [&](SurfaceTile& tile) {
        if (tile.any_surface) add_direct(tile, ReceiverKind::patch);
      },
      [&](const Surface& surface, std::uint64_t number, std::vector<IncidentLight>& found) {
        find_incident_on_patch(*samplers_.local(), surfaces_.environment() != nullptr, surface, number, found);
      }));
  gather_ = std::make_unique<const radiosity::Gather>(*patches_, surfaces_.rays(), fineness,
                                                      radiosity::Gather::Options{options.bounce_error, options.bounce_strict});
}

std::size_t SurfaceLight::solve_tiles(const Scene& scene, const RenderOptions& options) {
  return radiosity::solve_tiles(scene, {options.bounces, radiosity::fineness_of(options)});
}

void DirectLight::add(SurfaceTile& tile, ReceiverKind receiver, EstimatedShadows& scratch) const {
  const auto reaching = lights_reaching(lights, tile);
  tinted.add(tile, lighting, [&](TileLighting& past) {
    if (!past.has_shadows()) {
      past.add(tile, reaching.lights);
    } else if (receiver == ReceiverKind::patch && shadow_rays > 0) {
      scratch.clear();
      past.add_shadowed_by_rays(tile, reaching.lights, shadow_rays, FewRays::kPlacesOfEach, scratch);
    } else {
      past.add_shadowed(tile, reaching.lights);
    }
  });
  environment::HalvesOfRays halves;
  surfaces.add_environment(0, tile, halves);
}

void SurfaceLight::find(SurfaceTile& tile, Direct direct, Irradiance& result) {
  for (TilePlane* plane : {&result.error.x, &result.error.y, &result.error.z}) plane->fill(0);
  if (tile.any_surface && direct == Direct::on) add_direct(tile, ReceiverKind::asked);
  for (std::size_t i = 0; i < kTilePixels; ++i) put(result.value, i, get(tile.radiance, i) * std::numbers::pi_v<float>);
  if (!gather_) return;
  SixteenSurfaces some;
  for (std::size_t first = 0; first < kTilePixels; first += SixteenSurfaces::kLanes) {
    some.take(tile, first);
    if (some.lit == 0) continue;
    const radiosity::Gather::Result gathered = gather_->reflected(some, 0, {false, true});
    for (std::size_t i = 0; i < SixteenSurfaces::kLanes; ++i) {
      put(result.value, first + i, get(result.value, first + i) + gathered.radiance[i] * std::numbers::pi_v<float>);
      put(result.error, first + i, gathered.error[i] * std::numbers::pi_v<float>);
    }
  }
}

}  // namespace steradian
