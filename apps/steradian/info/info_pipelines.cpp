#include "info/info_pipelines.h"

#include <fmt/format.h>

#include "device/frame/back_end.h"
#include "device/plane/plane_device.h"
#include "render/render_plane.h"

namespace steradian::app {
namespace {

using Json = nlohmann::ordered_json;

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

Json pipeline_facts(const std::string& path, const Limits& limits, const RenderOptions& options) {
  Json list = Json::array();
  for (const vulkan::PipelineReport& p :
       is_plane_scene(path) ? plane_pipelines(path, limits, options) : scene_pipelines(path, limits, options)) {
    Json statistics = Json::object();
    for (const auto& [name, value] : p.statistics) statistics[name] = value;
    list.push_back({{"shader", p.shader},
                    {"constants", p.constants},
                    {"module_bytes", p.module_bytes},
                    {"ms", p.ms},
                    {"dispatches", p.dispatches},
                    {"groups", p.groups},
                    {"units", p.units},
                    {"statistics", statistics}});
  }
  return {{"pipelines", list}};
}

std::string pipeline_text(const Json& facts) {
  std::string text;
  for (const Json& p : facts.at("pipelines")) {
    text += fmt::format("{:<24} {:>8} bytes {:>8.1f} ms {:>5} dispatches", p.at("shader").get<std::string>(),
                        p.at("module_bytes").get<std::size_t>(), p.at("ms").get<double>(), p.at("dispatches").get<std::uint64_t>());
    for (const auto& [name, value] : p.at("statistics").items()) text += fmt::format(", {} {}", name, value.get<std::uint64_t>());
    text += "\n";
  }
  return text;
}

}  // namespace steradian::app
