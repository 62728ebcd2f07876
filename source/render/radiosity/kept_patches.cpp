#include "render/radiosity/kept_patches.h"

#include <tuple>

namespace steradian::radiosity {
namespace {

// The options that the light of patches depends on.
auto options_of(const RenderOptions& o) {
  return std::tie(o.bounces, o.quality, o.method, o.table, o.shadows, o.terminator, o.shadow_error);
}

}  // namespace

std::shared_ptr<const PatchLight> KeptPatches::light(const Scene& scene, const RenderOptions& options, const Solve& solve) {
  Kept& kept = kept_[options.bounce_preview ? 1 : 0];
  if (kept.light != nullptr && options_of(kept.options) == options_of(options) && kept.scene.is_lit_like(scene)) return kept.light;
  std::shared_ptr<const PatchLinks> links;
  if (kept.options.quality == options.quality && PatchLinks::serve_both(kept.scene, scene)) links = kept.links;
  std::shared_ptr<const PatchLight> light = solve(links);
  if (options.stop != nullptr && options.stop->load()) return light;  // it may be unfinished
  kept = {scene, options, light, links};
  kept.scene.cameras.clear();
  kept.options.progress = nullptr;
  kept.options.stop = nullptr;
  return light;
}

}  // namespace steradian::radiosity
