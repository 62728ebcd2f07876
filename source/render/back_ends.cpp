#include "render/cpu/render.h"
#include "render/vulkan/frame.h"

namespace steradian {

Picture render(const Scene& scene, const RenderOptions& options, RenderStats* stats, RenderState* state) {
  if (options.backend == Backend::cpu) return render_on_cpu(scene, options, stats, state);
  vulkan::Frame frame(scene, options);
  Picture picture = frame.render(stats);
  if (state != nullptr) state->complete = options.stop == nullptr || !options.stop->load(std::memory_order_relaxed);
  return picture;
}

}  // namespace steradian
