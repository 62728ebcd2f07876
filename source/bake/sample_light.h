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
  //
  //   solved  takes the fraction of the light between surfaces that is solved
  SampleLight(const Scene& scene, const RenderOptions& options, SurfaceLight::Direct direct, const WorkFraction& solved)
      : scene_(scene), options_(options), direct_(direct), light_(scene, options, solved) {}

  // The light of each sample with an area.
  //
  //   first_tile  number of the first tile, which seeds its random decisions
  //   advanced    called for each block
  std::vector<LitBlock> of(std::span<const PlacedBlock> blocks, std::uint64_t first_tile, const std::function<void()>& advanced);

  const SurfaceLight& surfaces() const { return light_; }

 private:
  const Scene& scene_;
  const RenderOptions& options_;
  const SurfaceLight::Direct direct_;
  SurfaceLight light_;
};

}  // namespace steradian::bake
