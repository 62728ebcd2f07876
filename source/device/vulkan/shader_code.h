// The words of a compute shader, with a name for reports.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace steradian::vulkan {

struct ShaderCode {
  std::string name;                      // of its file: "ltc.comp"
  std::span<const std::uint32_t> words;  // SPIR-V; must outlive this object
};

}  // namespace steradian::vulkan
