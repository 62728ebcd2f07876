#include "device/frame/back_end.h"

#include "device/frame/frame.h"
#include "device/frame/kept_on_device.h"
#include "render/frame/render.h"
#include "render/surface/local_scene.h"
#include "render/surface/ray_scene.h"

namespace steradian::vulkan {

Picture render_on_device(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state) {
  std::string lacks = lack_of_devices(scene, options);
  Picture picture;
  try {
    if (lacks.empty()) {
      DeviceFrame frame(scene, options, nullptr, SurfacesBy::automatic, RaysBy::automatic, cache);
      lacks = frame.lacks();
      if (lacks.empty()) picture = frame.render(stats);
    } else {
      const Device device({options.device, false});  // throws if there is none of that name
    }
  } catch (...) {  // a lost device is not used again
    if (cache != nullptr) cache->parts().on_device = {};
    throw;
  }
  if (!lacks.empty()) {
    picture = render_on_cpu(scene, options, cache, stats, state);
    if (stats != nullptr) stats->warnings.push_back("the CPU renders this picture, not the Vulkan device: " + lacks);
    return picture;
  }
  if (state != nullptr) state->complete = options.stop == nullptr || !options.stop->load(std::memory_order_relaxed);
  return picture;
}

std::vector<PipelineReport> compile_picture(const Scene& original, const RenderOptions& options) {
  const LocalScene local(original);
  const auto device = std::make_shared<const Device>(DeviceOptions{options.device, false, true});
  DeviceFrame frame(local.scene(), options, device);
  frame.render();
  return device->pipelines();
}

}  // namespace steradian::vulkan
