#include "device/vulkan/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "core/budget.h"
#include "device/vulkan/buffer.h"
#include "device/vulkan/compute_program.h"
#include "device/vulkan/handles.h"
#include "device/vulkan/shaders.h"
#include "steradian/error.h"

namespace steradian::vulkan::device_test {

TEST(VulkanDevice, UnknownNameIsRefusedWithTheNamesThereAre) {
  const auto devices = list_devices();
  try {
    Device device({"no such device", false});
    FAIL() << "opened " << device.info().name;
  } catch (const Error& e) {
    for (const DeviceInfo& d : devices) EXPECT_NE(std::string(e.what()).find(d.name), std::string::npos) << e.what();
  }
}

// Hardware devices come before software ones, so that the first one is the one to use.
TEST(VulkanDevice, SoftwareDevicesComeLast) {
  bool software = false;
  for (const DeviceInfo& d : list_devices()) {
    if (!d.runs) continue;
    EXPECT_FALSE(software && !d.software) << d.name;
    software = d.software;
  }
}

TEST(VulkanDevice, IsFoundByItsNumberAndByAPartOfItsName) {
  const auto devices = list_devices();
  if (devices.empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  EXPECT_EQ(Device({std::to_string(devices.size() - 1), false}).info().name, devices.back().name);
  EXPECT_EQ(Device({devices.front().name.substr(0, 4), false}).info().name, devices.front().name);
  EXPECT_GT(devices.front().memory, std::size_t{1} << 20);
}

TEST(VulkanDevice, MoreMemoryThanThereIsIsRefusedWithItsSize) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const Device device;
  const std::size_t bytes = std::size_t{1} << 46;
  try {
    Buffer buffer(device, bytes);
    FAIL() << "made a buffer of " << buffer.bytes();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(readable_bytes(bytes)), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("memory"), std::string::npos) << e.what();
  }
}

TEST(VulkanDevice, OneThatLacksSomethingIsRefusedWithItsName) {
  DeviceInfo info;
  info.name = "Small One";
  info.storage_buffer = std::size_t{64} << 20;
  info.texel_buffer = 65536;
  const auto expect_refused = [&](const std::string& words) {
    try {
      check_device(info, 5, "the plane");
      FAIL() << words;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("'Small One'"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  expect_refused("has no storage buffers of 128 MiB");
  info.storage_buffer = std::size_t{128} << 20;
  info.storage_buffers = 4;
  expect_refused("lets a shader have 4 storage buffers, the plane needs 5");
  info.storage_buffers = 5;
  expect_refused("has no subgroup ballots");
  info.broadcasts = true;
  EXPECT_NO_THROW(check_device(info, 5, "the plane"));
}

TEST(VulkanDevice, ThatOnlyCompilesCountsTheWorkAndRunsNothing) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const Device device({"", false, true});
  const Buffer buffer(device, 64);
  ComputeProgram program(device, {shader("bounce_lobes.comp")}, 3);
  ComputeProgram::Dispatch dispatch{program.pipeline(0, {64, 64}), 3, 5};
  dispatch.units = 7;
  EXPECT_TRUE(program.run({&buffer, &buffer, &buffer}, {dispatch, dispatch}).empty());
  ASSERT_EQ(device.pipelines().size(), 1u);
  const PipelineReport& made = device.pipelines().front();
  EXPECT_EQ(made.shader, "bounce_lobes.comp");
  EXPECT_EQ(made.constants, (std::vector<std::int32_t>{64, 64}));
  EXPECT_EQ(made.module_bytes, shader("bounce_lobes.comp").modules.front().words.size_bytes());
  EXPECT_EQ(made.dispatches, 2u);
  EXPECT_EQ(made.groups, 30u);
  EXPECT_EQ(made.units, 14u);
  const auto* bytes = static_cast<const char*>(buffer.mapped());
  EXPECT_TRUE(std::all_of(bytes, bytes + buffer.bytes(), [](char byte) { return byte == 0; }));
}

// Each kind of light has its own module of a lobe's shader.
TEST(VulkanDevice, TakesTheModuleThatServesTheConstants) {
  const ShaderCode code = shader("closed_form.comp");
  ASSERT_EQ(code.modules.size(), 5u);
  for (std::int32_t kind = 0; kind < 5; ++kind)
    for (std::size_t m = 0; m < code.modules.size(); ++m)
      EXPECT_EQ(code.modules[m].serves({kind}), m == static_cast<std::size_t>(kind)) << kind << " " << m;
  EXPECT_FALSE(code.modules.front().serves({}));
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const Device device({"", false, true});
  ComputeProgram program(device, {code}, 5, 6);
  EXPECT_THROW(program.pipeline(0, {5}), Error);
}

// Programs are cached: a later one may occupy the memory of an earlier one's words.
TEST(VulkanDevice, TellsProgramsApartByTheirWords) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const Device device;
  const auto one = shader("diffuse.comp"), other = shader("sheen.comp");
  const auto words_of = [](const ShaderCode& code) { return code.modules.front().words; };
  std::vector<std::uint32_t> words(std::max(words_of(one).size(), words_of(other).size()));
  for (const ShaderCode& code : {one, other, one}) {
    std::copy(words_of(code).begin(), words_of(code).end(), words.begin());
    const ComputeProgram program(device, {{code.name, {{{}, std::span(words).first(words_of(code).size())}}}}, 5, 6);
  }
  EXPECT_EQ(device.handles().pipelines.size(), 2u);
}

TEST(VulkanDevice, ItsLossIsAnErrorThatSaysWhatWasBeingDone) {
  try {
    checked("Vulkan", "run a compute shader", []() -> int { throw vk::DeviceLostError("gone"); });
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("run a compute shader: the device was lost"), std::string::npos) << e.what();
  }
}

}  // namespace steradian::vulkan::device_test
