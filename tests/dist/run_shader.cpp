// run_shader SPIRV INPUTS OUTPUTS: runs a compute shader on the first Vulkan device, 64 threads a group, one thread a case.
//
// Standard input has INPUTS floats a case, in the shader's binding 0. Standard output gets OUTPUTS floats a case, from its binding 1. Exit
// 77 if there is no device.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "device/vulkan/compute_program.h"

namespace {

template <class T>
std::vector<T> read_all(std::istream& from) {
  const std::string bytes((std::istreambuf_iterator<char>(from)), {});
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

void run(const char* spirv, std::size_t inputs, std::size_t outputs) {
  using namespace steradian::vulkan;
  std::ifstream file(spirv, std::ios::binary);
  const auto words = read_all<std::uint32_t>(file);
  const auto given = read_all<float>(std::cin);
  const std::size_t count = given.size() / inputs;
  std::vector<float> found(count * outputs);

  const Device device;
  Buffer in(device, given.size() * sizeof(float)), out(device, found.size() * sizeof(float));
  in.write(given.data(), in.bytes());
  ComputeProgram program(device, {{spirv, {{{}, words}}}}, 2);
  program.run({&in, &out}, {{program.pipeline(), static_cast<std::uint32_t>((count + 63) / 64)}});
  out.read(found.data(), out.bytes());
  std::fprintf(stderr, "%s\n", device.info().name.c_str());
  std::fwrite(found.data(), sizeof(float), found.size(), stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: run_shader SPIRV INPUTS OUTPUTS\n");
    return 2;
  }
  if (steradian::vulkan::list_devices().empty()) return 77;
  try {
    run(argv[1], std::strtoul(argv[2], nullptr, 10), std::strtoul(argv[3], nullptr, 10));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "run_shader: %s\n", e.what());
    return 1;
  }
  return 0;
}
