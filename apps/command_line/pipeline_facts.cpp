#include "pipeline_facts.h"

#include <fmt/format.h>

namespace steradian::app {

using Json = nlohmann::ordered_json;

Json facts_of(const std::vector<vulkan::PipelineReport>& pipelines) {
  Json list = Json::array();
  for (const vulkan::PipelineReport& p : pipelines) {
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
