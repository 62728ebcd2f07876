// SampleLight: the irradiance at samples of a scene's meshes.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "bake/samples.h"
#include "render/frame/surface_light.h"

namespace steradian::bake {

struct PlacedBlock {
  std::uint32_t mesh = 0;
  SampleBlock samples;
};

struct LitSample {
  Vec3f irradiance, error;
};
using LitBlock = std::array<LitSample, 16>;

class SampleLight {
 public:
  static constexpr std::size_t kBlocksPerTile = kTilePixels / 16;

  // As SurfaceLight, and on the threads of the caller's arena.
  SampleLight(const Scene& scene, const RenderOptions& options, SurfaceLight::Direct direct, const std::function<void()>& advanced)
      : scene_(scene), options_(options), direct_(direct), advanced_(advanced), light_(scene, options, advanced) {}

  // The light of each sample with an area. first_tile: number of the first tile, which seeds its random decisions.
  std::vector<LitBlock> of(std::span<const PlacedBlock> blocks, std::uint64_t first_tile);

  const SurfaceLight& surfaces() const { return light_; }

 private:
  const Scene& scene_;
  const RenderOptions& options_;
  const SurfaceLight::Direct direct_;
  const std::function<void()> advanced_;
  SurfaceLight light_;
};

}  // namespace steradian::bake
