#include <gtest/gtest.h>

#include <algorithm>

#include "gpu.h"

namespace steradian::parity {
namespace {

constexpr std::size_t kCount = 10000;

// Every case on the given targets: within the bound, and the same bits where they are promised.
void check_all(const std::vector<Target>& targets) {
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const CaseReport report = compare(index, targets, kCount);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const Difference& d = report.targets[t];
      EXPECT_EQ(d.beyond, 0u) << report.which->name << " on " << targets[t].name << ": " << d.first_beyond;
      if (targets[t].equal_in_arithmetic && report.which->arithmetic) {
        EXPECT_EQ(d.unequal, 0u) << report.which->name << " on " << targets[t].name << ": largest difference " << d.largest;
      }
    }
  }
}

}  // namespace

TEST(Parity, PacksAgreeWithScalarFloat) { check_all(cpu_targets()); }

// A bound that is nearly always infinite would make the other tests pass whatever the kernels do.
TEST(Parity, ErrorAnalysisBoundsNearlyEveryInput) {
  for (std::size_t index = 0; index < cases().size(); ++index) {
    const CaseReport report = compare(index, {}, 2000);
    EXPECT_LE(report.without_bound, report.inputs / 50) << report.which->name;
    EXPECT_LE(report.typical_bound, 1e-3) << report.which->name;
  }
}

TEST(Parity, ShadersAgreeWithScalarFloatAndTheValidationLayerIsSilent) {
  const auto devices = vulkan::list_devices();
  if (devices.empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  for (const vulkan::DeviceInfo& info : devices) {
    SCOPED_TRACE(info.name);
    const auto device = std::make_shared<vulkan::Device>(vulkan::DeviceOptions{info.name, true});
    check_all({gpu_target(device, ShaderText::glsl), gpu_target(device, ShaderText::hlsl)});
    EXPECT_TRUE(device->validation_messages().empty())
        << device->validation_messages().size() << " messages, the first: " << device->validation_messages().front();
  }
}

TEST(Parity, AMistakeInOnePreludeIsFound) {
  const auto devices = vulkan::list_devices();
  if (devices.empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const Target broken = gpu_target(std::make_shared<vulkan::Device>(), ShaderText::broken_glsl);
  std::size_t found = 0;
  for (std::size_t index = 0; index < cases().size(); ++index)
    found += compare(index, {broken}, 1000).targets[0].beyond > 0;
  EXPECT_GE(found, cases().size() / 4) << "a select with its sides exchanged shows in " << found << " cases";
}

}  // namespace steradian::parity
