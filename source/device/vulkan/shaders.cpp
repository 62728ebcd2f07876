#include "device/vulkan/shaders.h"

#include <string>

#include "steradian/error.h"

namespace steradian::vulkan {

ShaderCode shader(std::string_view name) {
#include "steradian_render_shaders.inc"
  throw Error("Vulkan", "this build has no shader " + std::string(name));
}

}  // namespace steradian::vulkan
