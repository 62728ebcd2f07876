#include "render/vulkan/device.h"

#include <gtest/gtest.h>

#include "steradian/error.h"

namespace steradian::vulkan {

TEST(VulkanDevice, UnknownNameIsRefusedWithTheNamesThereAre) {
  const auto devices = list_devices();
  try {
    Device device({"no such device", false});
    FAIL() << "opened " << device.info().name;
  } catch (const Error& e) {
    for (const DeviceInfo& d : devices) EXPECT_NE(std::string(e.what()).find(d.name), std::string::npos) << e.what();
  }
}

// Real devices come before software ones, so that the first is the one to use.
TEST(VulkanDevice, SoftwareDevicesComeLast) {
  bool software = false;
  for (const DeviceInfo& d : list_devices()) {
    EXPECT_FALSE(software && !d.software) << d.name;
    software = d.software;
  }
}

}  // namespace steradian::vulkan
