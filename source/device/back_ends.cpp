#include "device/frame/back_end.h"
#include "render/frame/render.h"
#include "render/surface/local_scene.h"

namespace steradian {

namespace {

Picture render_by(const Scene& original, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state) {
  const LocalScene local(original);
  const Scene& scene = local.scene();
  if (options.backend == Backend::cpu) return render_on_cpu(scene, options, cache, stats, state);
  return vulkan::render_on_device(scene, options, cache, stats, state);
}

}  // namespace

Picture render(const Scene& scene, const RenderOptions& options, RenderStats* stats, RenderState* state) {
  return render_by(scene, options, nullptr, stats, state);
}

Picture render(const Scene& scene, const RenderOptions& options, RenderCache& cache, RenderStats* stats, RenderState* state) {
  return render_by(scene, options, &cache, stats, state);
}

}  // namespace steradian
