// The parity cases as compute shaders: the same inputs, on a Vulkan device.
#pragma once

#include <memory>

#include "compare.h"
#include "device/vulkan/device.h"

namespace steradian::parity {

enum class ShaderText { glsl, hlsl, broken_glsl };  // broken: a mistake in the prelude, to test the test

// The cases on one device. A software device keeps IEEE arithmetic, so its results must be equal to the bit.
Target gpu_target(std::shared_ptr<vulkan::Device> device, ShaderText text);

// The same with shaders from elsewhere, such as translations of WGSL: a folder with one module per case (split_spirv.py).
Target gpu_target(std::shared_ptr<vulkan::Device> device, const std::string& name, const std::string& folder);

}  // namespace steradian::parity
