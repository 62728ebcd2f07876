// PipelineReport: a pipeline's size, work, and the statistics of the driver's compiler.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace steradian::vulkan {

// One shader of a pipeline: compute pipelines have one, pipelines that draw have one for each stage.
struct PipelineReport {
  std::string shader;                   // name of its file: "ltc.comp"
  std::vector<std::int32_t> constants;  // specialisation constants, by their numbers
  std::size_t module_bytes = 0;         // SPIR-V
  double ms = 0;                        // time to make the pipeline
  std::uint64_t dispatches = 0, groups = 0;
  std::uint64_t units = 0;  // of the shader's work, as far as the host counts them: Dispatch::units
  // Statistics by the driver's names, such as "Instructions"; empty if the driver reports none, or nobody asked (DeviceOptions).
  std::vector<std::pair<std::string, std::uint64_t>> statistics = {};
};

}  // namespace steradian::vulkan
