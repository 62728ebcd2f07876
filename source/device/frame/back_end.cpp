#include "device/frame/back_end.h"

#include <algorithm>
#include <future>

#include "device/frame/frame.h"
#include "device/frame/kept_on_device.h"
#include "render/frame/render.h"
#include "render/surface/local_scene.h"
#include "render/surface/ray_scene.h"
#include "steradian/area_light.h"  // luminance

namespace steradian::vulkan {
namespace {

double light_of(const Picture& picture) {
  double sum = 0;
  for (const Vec3f& p : picture.pixels) sum += luminance(static_cast<Vec3d>(p));
  return sum;
}

// The device renders direct light, while the CPU solves and gathers the light between surfaces.
Picture render_with_bounces(DeviceFrame& frame, const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats) {
  RenderStats of_bounces;
  std::future<Picture> bounces =
      std::async(std::launch::async, [&] { return render_on_cpu(scene, options, cache, &of_bounces, nullptr, LightOf::bounces); });
  Picture picture = frame.render(stats);
  Picture more = bounces.get();
  const double light = light_of(more);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] += more.pixels[i];
  picture.layers.merge(more.layers);
  if (stats == nullptr) return picture;
  for (const PassTime& pass : of_bounces.passes)
    if (pass.name.starts_with("bounces")) stats->passes.push_back(pass);
  stats->patches = of_bounces.patches;
  stats->bounce_iterations = of_bounces.bounce_iterations;
  stats->patch_rays = of_bounces.patch_rays;
  stats->bounce_glossy = of_bounces.bounce_glossy;
  stats->bounce_glossy_evenly = of_bounces.bounce_glossy_evenly;
  stats->bounce_left_out = of_bounces.bounce_left_out;
  stats->bounce_error = light > 0 ? of_bounces.bounce_error * light / light_of(picture) : 0;
  stats->total_ms = std::max(stats->total_ms, of_bounces.total_ms);
  return picture;
}

}  // namespace

Picture render_on_device(const Scene& scene, const RenderOptions& options, RenderCache* cache, RenderStats* stats, RenderState* state) {
  std::string lacks = lack_of_devices(scene, options);
  Picture picture;
  try {
    if (lacks.empty()) {
      DeviceFrame frame(scene, options, nullptr, SurfacesBy::automatic, RaysBy::automatic, cache);
      lacks = frame.lacks();
      if (lacks.empty()) picture = options.bounces != 0 ? render_with_bounces(frame, scene, options, cache, stats) : frame.render(stats);
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
