#include "device/frame/back_end.h"

#include "render/frame/render.h"
#include "render/surface/scene_parts.h"
#include "device/frame/frame.h"
#include "device/frame/kept_on_device.h"

namespace steradian::vulkan {

Picture render_on_device(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state) {
  if (runs_on_host_alone(scene, options)) {
    const Device device({options.device, false});
    Picture picture = render_on_cpu(scene, options, cache, stats, state);
    if (stats != nullptr)
      stats->warnings.push_back(
          "the CPU renders all of this picture: " + (options.lights == LightSum::tree ? "--lights tree" : "the method " + options.method) +
          " has nothing for the device '" + device.info().name + "'");
    return picture;
  }
  Picture picture;
  try {
    picture = Frame(scene, options, nullptr, SurfacesBy::automatic, RaysBy::automatic, cache).render(stats);
  } catch (...) {  // a lost device is not used again
    if (cache != nullptr) cache->parts().on_device = {};
    throw;
  }
  if (state != nullptr) state->complete = options.stop == nullptr || !options.stop->load(std::memory_order_relaxed);
  return picture;
}

}  // namespace steradian::vulkan
