#include "render/cpu/render.h"
#include "render/cpu/scene_parts.h"
#include "render/vulkan/frame.h"

namespace steradian {

namespace {

Picture render_by(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state) {
  if (options.backend == Backend::cpu) return render_on_cpu(scene, options, cache, stats, state);
  if (vulkan::runs_on_host_alone(scene, options)) {
    const vulkan::Device device({options.device, false});
    Picture picture = render_on_cpu(scene, options, cache, stats, state);
    if (stats != nullptr)
      stats->warnings.push_back(
          "the CPU renders all of this picture: " + (options.lights == LightSum::tree ? "--lights tree" : "the method " + options.method) +
          " has nothing for the device '" + device.info().name + "'");
    return picture;
  }
  Picture picture;
  try {
    picture = vulkan::Frame(scene, options, nullptr, vulkan::SurfacesBy::automatic, vulkan::RaysBy::automatic, cache).render(stats);
  } catch (...) {  // what is lost is not asked again
    if (cache != nullptr) cache->parts().on_device = {};
    throw;
  }
  if (state != nullptr) state->complete = options.stop == nullptr || !options.stop->load(std::memory_order_relaxed);
  return picture;
}

}  // namespace

Picture render(const Scene& scene, const RenderOptions& options, RenderStats* stats, RenderState* state) {
  return render_by(scene, options, nullptr, stats, state);
}

Picture render(const Scene& scene, const RenderOptions& options, RenderCache& cache, RenderStats* stats, RenderState* state) {
  return render_by(scene, options, &cache, stats, state);
}

}  // namespace steradian
