#include "render/radiosity/kept_patches.h"

#include <tuple>
#include <utility>

namespace steradian::radiosity {
namespace {

// The options that the light of patches depends on.
auto options_of(const RenderOptions& o) {
  return std::tie(o.bounces, o.quality, o.method, o.table, o.shadows, o.terminator, o.shadow_error);
}

}  // namespace

std::shared_ptr<const PatchLight> KeptPatches::find(const Scene& scene, const RenderOptions& options) const {
  const Kept& kept = kept_[options.bounce_preview ? 1 : 0];
  if (kept.light == nullptr || options_of(kept.options) != options_of(options) || !kept.scene.is_lit_like(scene)) return nullptr;
  return kept.light;
}

void KeptPatches::keep(const Scene& scene, const RenderOptions& options, std::shared_ptr<const PatchLight> light) {
  Kept& kept = kept_[options.bounce_preview ? 1 : 0];
  kept = {scene, options, std::move(light)};
  kept.options.progress = nullptr;
  kept.options.stop = nullptr;
  kept.scene.cameras.clear();
}

}  // namespace steradian::radiosity
