#include "render/frame/all_light.h"

#include <cmath>

#include "steradian/area_light.h"  // luminance

namespace steradian {

AllLight::AllLight(const Scene& scene, const SceneParts& parts, const RenderOptions& options,
                   const radiosity::PatchLight::AddDirect& add_direct)
    : width_(options.width),
      patches_([&] {
        const auto start = Clock::now();
        radiosity::PatchLight light(scene, *parts.rays, *parts.maps, {options.bounces, options.quality}, add_direct);
        solve_ms_ = ms_since(start);
        return light;
      }()),
      gather_(patches_, *parts.rays, options.quality, options.aa) {}

void AllLight::begin(Picture& picture) {
  for (const char* layer : {"indirect", "bounce_error"}) picture.layers[layer].resize(picture.pixels.size());
}

void AllLight::add(SurfaceTile& tile, TileArea area, int sample, const TileVector* shares, float weight, Picture& picture) {
  TileVector light{}, error{};
  clock_.run([&] {
    SixteenSurfaces some;
    for (std::size_t first = 0; first < kTilePixels; first += SixteenSurfaces::kLanes) {
      some.take(tile, first);
      if (some.lit == 0) continue;
      const radiosity::Gather::Result result = gather_.reflected(some, sample);
      for (std::size_t i = 0; i < SixteenSurfaces::kLanes; ++i) {
        const Vec3f r = result.radiance[i], e = result.error[i];
        light.x[first + i] = r.x;
        light.y[first + i] = r.y;
        light.z[first + i] = r.z;
        error.x[first + i] = e.x;
        error.y[first + i] = e.y;
        error.z[first + i] = e.z;
        tile.radiance.x[first + i] += r.x;
        tile.radiance.y[first + i] += r.y;
        tile.radiance.z[first + i] += r.z;
      }
    }
  });
  add_to_picture(light, area, shares, weight, picture.layers.at("indirect"), width_);
  add_to_picture(error, area, shares, weight, picture.layers.at("bounce_error"), width_);
}

void AllLight::report(int threads, RenderStats& stats, const Picture& picture) const {
  stats.passes.push_back({"bounces: patches", solve_ms_});
  stats.passes.push_back(clock_.time(threads));
  stats.patches = patches_.patches().side_count() / 2;
  stats.bounce_iterations = patches_.iterations();
  stats.bounce_residual = patches_.residual();
  double squares = 0, light = 0;
  for (const Vec3f& e : picture.layers.at("bounce_error")) squares += std::pow(luminance(static_cast<Vec3d>(e)), 2);
  for (const Vec3f& p : picture.pixels) light += luminance(static_cast<Vec3d>(p));
  const auto count = static_cast<double>(picture.pixels.size());
  stats.bounce_error = light > 0 ? std::sqrt(squares / count) / (light / count) : 0;
}

}  // namespace steradian
