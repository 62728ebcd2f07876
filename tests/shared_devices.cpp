// All tests of a process share one Vulkan device, and so its pipelines.
#include <gtest/gtest.h>

#include <optional>

#include "device/vulkan/device.h"

namespace {

class SharedDevicesOfTests : public testing::Environment {
  void SetUp() override { devices_.emplace(); }
  void TearDown() override { devices_.reset(); }
  std::optional<steradian::vulkan::SharedDevices> devices_;
};

const testing::Environment* const kShared = testing::AddGlobalTestEnvironment(new SharedDevicesOfTests);

}  // namespace
