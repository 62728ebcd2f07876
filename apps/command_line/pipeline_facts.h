// Reports of a device's pipelines, as JSON and for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "device/vulkan/pipeline_report.h"

namespace steradian::app {

// For each pipeline: shader, constants, SPIR-V bytes, milliseconds, work, and the statistics of the driver's compiler.
nlohmann::ordered_json facts_of(const std::vector<vulkan::PipelineReport>& pipelines);

// The same for people: a line for each pipeline.
std::string pipeline_text(const nlohmann::ordered_json& facts);

}  // namespace steradian::app
