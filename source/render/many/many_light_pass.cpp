#include "render/many/many_light_pass.h"

#include <algorithm>

namespace steradian {
namespace {

// Place of each slot in a tile: x + y times the tile's side.
constexpr std::array<std::uint16_t, kTilePixels> places_of_slots() {
  std::array<std::uint16_t, kTilePixels> places{};
  for (int y = 0; y < kTileSide; ++y)
    for (int x = 0; x < kTileSide; ++x) places[tile_slot(x, y)] = static_cast<std::uint16_t>(y * kTileSide + x);
  return places;
}

}  // namespace

ManyLightPass::ManyLightPass(const std::vector<PackLight>& lights, Vec3f eye, float error)
    : sum_(lights, eye, error),
      serves_all_(std::all_of(lights.begin(), lights.end(), [this](const PackLight& l) { return sum_.serves(l); })) {}

std::vector<const PackLight*> ManyLightPass::others(const std::vector<const PackLight*>& lights) const {
  std::vector<const PackLight*> rest;
  if (!serves_all_)
    std::copy_if(lights.begin(), lights.end(), std::back_inserter(rest), [this](const PackLight* l) { return !sum_.serves(*l); });
  return rest;
}

std::vector<const PackLight*> ManyLightPass::add_to_tile(SurfaceTile& tile, const std::vector<const PackLight*>& lights) {
  std::vector<const PackLight*> served;
  std::copy_if(lights.begin(), lights.end(), std::back_inserter(served), [this](const PackLight* l) { return sum_.serves(*l); });
  sum_.add_diffuse(tile, served, bound(), *workspace().sum);
  return others(lights);
}

void ManyLightPass::take(const SurfaceTile& tile, TileArea area, int width) {
  static constexpr std::array<std::uint16_t, kTilePixels> places = places_of_slots();
  workspace().block.add(tile, [&](std::uint32_t slot) {
    const int x = area.x + places[slot] % kTileSide, y = area.y + places[slot] / kTileSide;
    return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) + static_cast<std::uint32_t>(x);
  });
}

void ManyLightPass::add_block(float weight, Picture& picture) {
  Workspace& work = workspace();
  lights::ReceiverSet& block = work.block;
  sum_.add_diffuse(block, *work.sum);
  std::vector<Vec3f>& bounds = picture.layers.at("light_bound");
  for (std::size_t k = 0; k < block.points.size(); ++k) {
    const std::uint32_t pixel = block.points[k].place;
    picture.pixels[pixel] += block.received[k].radiance * weight;
    bounds[pixel] += block.received[k].bound * weight;
  }
}

void ManyLightPass::report(RenderStats& stats) const {
  stats.light_tree = true;
  lights::Counts all;
  for (const auto& work : workspaces_) all += lights::ManyLights::counts(*work->sum);
  const double points = std::max(static_cast<double>(all.points), 1.0);
  stats.light_elements = static_cast<double>(all.elements) / points;
  stats.light_outlines = static_cast<double>(all.outlines) / points;
}

}  // namespace steradian
