// The shaders of shaders/, compiled at build time and part of the program.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace steradian::vulkan {

// The words of a shader of the renderer by the name of its file: "ltc.comp". Throws Error if there is none.
std::span<const std::uint32_t> shader(std::string_view name);

}  // namespace steradian::vulkan
