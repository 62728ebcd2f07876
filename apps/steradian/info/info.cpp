// steradian info: the version and this machine's features; steradian info SCENE: the contents of a scene or of a drawing.
#include <fmt/format.h>
#include <xsimd/config/xsimd_config.hpp>
#include <simdjson.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "core/budget.h"
#include "core/simd.h"
#include "device/vulkan/device.h"
#include "info/info_pipelines.h"
#include "info/info_plane.h"
#include "info/info_scene.h"
#include "pipeline_facts.h"
#include "render/picture_options.h"
#include "render/render_plane.h"
#include "steradian/version.h"
#include "verbs.h"

namespace steradian::app {
namespace {

using Json = nlohmann::ordered_json;

// All facts of `info`, by key; the text form prints the same. A new fact is one more entry.
Json facts() {
  Json info;
  info["version"] = version();
#if defined(__clang__)
  info["compiler"] = "clang " __clang_version__;
#else
  info["compiler"] = "g++ " __VERSION__;
#endif
  info["instruction_sets"] = Json::array();
  for (const Simd simd : available_simd()) info["instruction_sets"].push_back(name_of(simd));
  info["simd"] = name_of(active_simd());
  info["lanes"] = lanes_of(active_simd());
  info["threads"] = std::thread::hardware_concurrency();
  info["vulkan_devices"] = Json::array();  // none: no loader, or no driver for Vulkan 1.2
  for (const vulkan::DeviceInfo& d : vulkan::list_devices())
    info["vulkan_devices"].push_back({{"number", info["vulkan_devices"].size()},
                                      {"name", d.name},
                                      {"driver", d.driver},
                                      {"vulkan", d.vulkan},
                                      {"software", d.software},
                                      {"runs", d.runs},
                                      {"memory", readable_bytes(d.memory)},
                                      {"storage_buffer", readable_bytes(d.storage_buffer)},
                                      {"storage_buffers_of_a_shader", d.storage_buffers},
                                      {"texels_of_a_buffer", d.texel_buffer},
                                      {"subgroup", d.subgroup},
                                      {"timestamps", d.timestamps}});
  const auto dotted = [](int a, int b, int c) { return fmt::format("{}.{}.{}", a, b, c); };
  info["libraries"] = {
      {"xsimd", dotted(XSIMD_VERSION_MAJOR, XSIMD_VERSION_MINOR, XSIMD_VERSION_PATCH)},
      {"simdjson", dotted(simdjson::SIMDJSON_VERSION_MAJOR, simdjson::SIMDJSON_VERSION_MINOR, simdjson::SIMDJSON_VERSION_REVISION)},
      {"nlohmann_json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"cli11", command_line_library()},
  };
  return info;
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_structured()) return value.dump();
  if (value.empty()) return "none";
  std::string text;
  for (const auto& [key, item] : value.items())
    text += (text.empty() ? "" : ", ") + (value.is_object() ? key + " " : std::string()) + text_of(item);
  return text;
}

}  // namespace

void add_info(CommandLine& line) {
  Verb verb = line.verb("info", "Print the contents of a scene (.gltf, .glb, .svg), or the facts of this machine");
  verb.group("This machine");
  struct Options {
    std::string scene;
    std::string size = "1280x720";
    bool json = false, pipelines = false;
    Limits limits;
    RenderOptions render;
  };
  auto options = std::make_shared<Options>();
  RenderOptions& r = options->render;
  r.shadows = Shadows::on;
  verb.add("SCENE", options->scene, "scene file; without one: version, instruction sets, devices");
  verb.add_flag("--json", options->json, "print JSON");
  const char* pipelines = "Pipelines of a Vulkan device";
  verb.add_flag("--pipelines", options->pipelines, "list those of a picture of SCENE, with the compiler's statistics").more(pipelines);
  verb.add("--device", r.device, "number or part of the name; its hardware may be absent").more(pipelines);
  verb.add("--size", options->size, "WIDTHxHEIGHT in pixels").more(pipelines);
  verb.add("--method", r.method, "method of the specular lobe")
      .check([](const std::string& name) { return unknown_method(name, false); })
      .suggests(method_names())
      .more(pipelines);
  verb.add_word("--quality", r.quality, "accuracy of the method").more(pipelines);
  verb.add_word("--shadows", r.shadows, "direct shadows").more(pipelines);
  verb.add_word("--indirect", r.indirect.mode, "one bounce").more(pipelines);
  verb.add("--vpls", r.indirect.virtual_lights, "number of its virtual lights").range(64, 1 << 22).more(pipelines);
  verb.add_limits(options->limits);
  verb.callback([options, verb] {
    const bool listed = options->pipelines, in_space = listed && !is_plane_scene(options->scene);
    const char *needs = "SCENE --pipelines", *third = "--pipelines of a scene in three dimensions (.gltf, .glb)";
    verb.refuse_without_effect({{"--pipelines", !options->scene.empty(), "SCENE"},
                                {"--device", listed, needs},
                                {"--size", listed, needs},
                                {"--method", in_space, third},
                                {"--quality", in_space, third},
                                {"--shadows", in_space, third},
                                {"--indirect", in_space, third},
                                {"--vpls", in_space && options->render.indirect.mode != IndirectMode::off, "--pipelines and --indirect"}});
    if (listed) {
      const PictureSize size = picture_size(options->size);
      options->render.width = size.width;
      options->render.height = size.height;
      const Json found = pipeline_facts(options->scene, options->limits, options->render);
      return options->json ? fmt::print("{}\n", found.dump(1)) : fmt::print("{}", pipeline_text(found));
    }
    const Json info = options->scene.empty()           ? facts()
                      : is_plane_scene(options->scene) ? plane_facts(options->scene, options->limits)
                                                       : scene_facts(options->scene, options->limits);
    if (!options->scene.empty() && !options->json) return fmt::print("{}", scene_text(info));
    if (options->json) return fmt::print("{}\n", info.dump(1));
    for (auto [key, value] : info.items()) {
      std::string label = key;
      std::replace(label.begin(), label.end(), '_', ' ');
      fmt::print("{:<17} {}\n", label, text_of(value));
    }
  });
}

}  // namespace steradian::app
