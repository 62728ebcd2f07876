#include "bake/sample_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "core/float_mode.h"
#include "render/surface/gbuffer.h"

namespace steradian::bake {
namespace {

// The front of a mesh at a sample, without its material: light maps hold the light before textures and bumps.
Surface surface_at_sample(const Mesh& mesh, const Sample& sample, Terminator terminator) {
  Surface s;
  const std::size_t first = 3 * std::size_t{sample.triangle};
  const std::uint32_t i0 = mesh.indices[first], i1 = mesh.indices[first + 1], i2 = mesh.indices[first + 2];
  const auto mean = [&](const std::vector<Vec3f>& values) {
    return values[i0] * (1 - sample.u - sample.v) + values[i1] * sample.u + values[i2] * sample.v;
  };
  s.geometric_normal = static_cast<Vec3f>(normalized(across(mesh, sample.triangle)));
  const Vec3f normal = mean(mesh.normals);
  // Normals that turn away from their triangle would see through it.
  s.normal = dot(normal, s.geometric_normal) > 0 ? normalized(normal) : s.geometric_normal;
  s.tangent = static_cast<Vec3f>(Frame::from_normal(static_cast<Vec3d>(s.normal)).x);
  s.position = terminator == Terminator::smooth ? smooth_position(mesh, sample.triangle, sample.u, sample.v, s.geometric_normal)
                                                : mean(mesh.positions);
  return s;
}

}  // namespace

std::vector<LitBlock> SampleLight::of(std::span<const PlacedBlock> blocks, std::uint64_t first_tile,
                                      const std::function<void()>& advanced) {
  std::vector<LitBlock> result(blocks.size());
  const std::size_t tiles = (blocks.size() + kBlocksPerTile - 1) / kBlocksPerTile;
  tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t number) {
    if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed)) return;
    const FlushDenormals flush;
    const auto tile = std::make_unique<SurfaceTile>();
    clear_kinds(*tile);
    tile->seed = first_tile + number;
    const std::size_t first = number * kBlocksPerTile;
    for (std::size_t i = 0; i < kTilePixels; ++i) {
      put_nothing(*tile, i);
      const std::size_t b = first + i / 16;
      if (b >= blocks.size()) continue;
      const Sample& sample = blocks[b].samples[i % 16];
      if (!(sample.area > 0)) continue;
      put_white(*tile, i, surface_at_sample(scene_.meshes[blocks[b].mesh], sample, options_.terminator));
    }
    const auto light = std::make_unique<SurfaceLight::Irradiance>();
    light_.find(*tile, direct_, *light);
    for (std::size_t i = 0; i < kTilePixels && first + i / 16 < blocks.size(); ++i)
      result[first + i / 16][i % 16] = {get(light->value, i), get(light->error, i)};
    for (std::size_t b = first; b < std::min(first + kBlocksPerTile, blocks.size()); ++b) advanced();
  });
  return result;
}

}  // namespace steradian::bake
