#include "gpu.h"

#include <cstring>
#include <fstream>
#include <iterator>

#include "device/vulkan/compute_program.h"
#include "steradian/error.h"

namespace steradian::parity {
namespace {

std::vector<std::uint32_t> read_words(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  if (bytes.empty()) throw Error(path, "holds no shader", "build the target parity_texts");
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), words.size() * 4);
  return words;
}

}  // namespace

Target gpu_target(std::shared_ptr<vulkan::Device> device, ShaderText text) {
  switch (text) {
    case ShaderText::glsl: return gpu_target(std::move(device), "GLSL", PARITY_SHADERS "/glsl");
    case ShaderText::hlsl: return gpu_target(std::move(device), "HLSL", PARITY_SHADERS "/hlsl");
    case ShaderText::broken_glsl: break;
  }
  return gpu_target(std::move(device), "broken GLSL", PARITY_SHADERS "/broken_glsl");
}

Target gpu_target(std::shared_ptr<vulkan::Device> device, const std::string& name, const std::string& folder) {
  const bool software = device->info().software;
  const auto run = [device, folder](std::size_t index, const std::vector<float>& inputs) {
    const std::size_t count = inputs.size() / kInputs;
    std::vector<float> results(count * kResults);
    vulkan::Buffer in(*device, inputs.size() * sizeof(float)), out(*device, results.size() * sizeof(float));
    in.write(inputs.data(), in.bytes());
    const std::vector<std::uint32_t> spirv = read_words(folder + "/" + cases()[index].name + ".spv");
    vulkan::ComputeProgram program(*device, {{cases()[index].name, {{{}, spirv}}}}, 2);
    program.run({&in, &out}, {{program.pipeline(), static_cast<std::uint32_t>((count + 63) / 64)}});
    out.read(results.data(), out.bytes());
    return results;
  };
  return {(software ? "software " : "GPU ") + name, Rounding::gpu, software, run};
}

}  // namespace steradian::parity
