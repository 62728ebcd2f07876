// The shaders of shaders/, compiled at build time and part of the program.
#pragma once

#include <string_view>

#include "device/vulkan/shader_code.h"

namespace steradian::vulkan {

// A shader of the renderer by the name of its file: "ltc.comp". Throws Error if there is none.
ShaderCode shader(std::string_view name);

}  // namespace steradian::vulkan
