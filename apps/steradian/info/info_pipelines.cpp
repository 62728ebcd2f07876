#include "info/info_pipelines.h"

#include "device/frame/back_end.h"
#include "device/plane/plane_device.h"
#include "pipeline_facts.h"
#include "render/render_plane.h"

namespace steradian::app {
namespace {

std::vector<vulkan::PipelineReport> plane_pipelines(const std::string& path, const Limits& limits, const RenderOptions& options) {
  PlaneFrameOptions frame;
  frame.width = options.width;
  frame.height = options.height;
  frame.threads = options.threads;
  frame.limits = limits;
  const PlaneWorld world(load_plane_scene(path, limits).scene, limits);
  return plane::compile_picture(world, frame, options.device);
}

std::vector<vulkan::PipelineReport> scene_pipelines(const std::string& path, const Limits& limits, const RenderOptions& options) {
  LoadOptions load;
  load.limits = limits;
  load.near_origin = true;
  load.aspect = static_cast<double>(options.width) / options.height;
  return vulkan::compile_picture(load_scene(path, load).scene, options);
}

}  // namespace

nlohmann::ordered_json pipeline_facts(const std::string& path, const Limits& limits, const RenderOptions& options) {
  return facts_of(is_plane_scene(path) ? plane_pipelines(path, limits, options) : scene_pipelines(path, limits, options));
}

}  // namespace steradian::app
