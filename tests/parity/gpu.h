// The parity cases as compute shaders: the same inputs, on a Vulkan device.
#pragma once

#include <memory>

#include "compare.h"
#include "render/vulkan/device.h"

namespace steradian::parity {

enum class ShaderText { glsl, hlsl, broken_glsl };  // broken: a mistake in the prelude, for the test of the test

// The cases on one device. A software device keeps IEEE arithmetic, so that bits are demanded of it.
Target gpu_target(std::shared_ptr<vulkan::Device> device, ShaderText text);

// The same with shaders from elsewhere, such as translations of WGSL: a folder of one module per case (split_spirv.py).
Target gpu_target(std::shared_ptr<vulkan::Device> device, const std::string& name, const std::string& folder);

}  // namespace steradian::parity
