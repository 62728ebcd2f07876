// The words of a compute shader, with a name for reports.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace steradian::vulkan {

// One module of a shader: it serves pipelines whose specialisation constants have these values, by their numbers.
struct ShaderModuleCode {
  std::vector<std::pair<std::uint32_t, std::int32_t>> fixed;
  std::span<const std::uint32_t> words;  // SPIR-V; must outlive this object

  bool serves(const std::vector<std::int32_t>& constants) const {
    for (const auto& [id, value] : fixed)
      if (id >= constants.size() || constants[id] != value) return false;
    return true;
  }
};

struct ShaderCode {
  std::string name;  // of its file: "ltc.comp"
  std::vector<ShaderModuleCode> modules;
};

}  // namespace steradian::vulkan
