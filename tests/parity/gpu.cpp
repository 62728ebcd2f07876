#include "gpu.h"

#include "render/vulkan/compute_pipeline.h"

namespace steradian::parity {
namespace {

const std::vector<std::uint32_t> kGlsl = {
#include "parity_glsl.inc"
};
const std::vector<std::uint32_t> kHlsl = {
#include "parity_hlsl.inc"
};
const std::vector<std::uint32_t> kBrokenGlsl = {
#include "parity_broken_glsl.inc"
};

const std::vector<std::uint32_t>& spirv_of(ShaderText text) {
  switch (text) {
    case ShaderText::glsl: return kGlsl;
    case ShaderText::hlsl: return kHlsl;
    case ShaderText::broken_glsl: break;
  }
  return kBrokenGlsl;
}

std::string name_of(ShaderText text) {
  switch (text) {
    case ShaderText::glsl: return "GLSL";
    case ShaderText::hlsl: return "HLSL";
    case ShaderText::broken_glsl: break;
  }
  return "broken GLSL";
}

}  // namespace

Target gpu_target(std::shared_ptr<vulkan::Device> device, ShaderText text) {
  return gpu_target(std::move(device), name_of(text), spirv_of(text));
}

Target gpu_target(std::shared_ptr<vulkan::Device> device, const std::string& name, std::vector<std::uint32_t> spirv) {
  const bool software = device->info().software;
  const auto run = [device, spirv = std::move(spirv)](std::size_t index, std::vector<float> inputs) {
    const std::size_t count = inputs.size() / kInputs;
    std::vector<float> results(count * kResults);
    // GLSL and HLSL take the case's number as a constant, WGSL from the vector behind the inputs.
    inputs.insert(inputs.end(), {static_cast<float>(index), 0.0f, 0.0f, 0.0f});
    vulkan::Buffer in(*device, inputs.size() * sizeof(float)), out(*device, results.size() * sizeof(float));
    in.write(inputs.data(), in.bytes());
    vulkan::ComputePipeline pipeline(*device, spirv, 2, {static_cast<std::int32_t>(index)});
    pipeline.run({&in, &out}, static_cast<std::uint32_t>((count + 63) / 64));
    out.read(results.data(), out.bytes());
    return results;
  };
  return {(software ? "software " : "GPU ") + name, Rounding::gpu, software, run};
}

}  // namespace steradian::parity
