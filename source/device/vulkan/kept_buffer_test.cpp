#include "device/vulkan/buffer.h"

#include <gtest/gtest.h>
#include <vector>

#include "steradian/error.h"

namespace steradian::vulkan::kept_buffer_test {
namespace {

TEST(KeptBuffer, GrowsAndWritesWhatIsNew) {
  if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device here: install mesa-vulkan-drivers for a software one";
  const Device device;
  KeptBuffer buffer(device);
  EXPECT_FALSE(buffer.is_made());
  std::vector<int> values(1000, 7);
  const auto held = [&] { return static_cast<int*>(buffer.get().mapped()); };
  EXPECT_EQ(buffer.hold(values).bytes(), 4000u);
  EXPECT_EQ(held()[999], 7);
  held()[0] = 1;
  buffer.hold(values);
  EXPECT_EQ(held()[0], 1) << "written again";
  values[5] = 8;
  buffer.hold(values);
  EXPECT_EQ(held()[0], 7);
  EXPECT_EQ(held()[5], 8);
  EXPECT_EQ(device.allocations(), 1u);

  values.resize(500);
  EXPECT_EQ(buffer.hold(values).bytes(), 4000u);
  EXPECT_EQ(device.allocations(), 1u);
  EXPECT_EQ(buffer.fit_with_room(4400, "numbers").bytes(), 6600u);
  held()[5] = 0;
  buffer.hold(values);
  EXPECT_EQ(held()[5], 8) << "what it held was lost";
  EXPECT_EQ(buffer.fit_with_room(6602, "numbers").bytes(), 9903u);
  EXPECT_EQ(buffer.fit(1).bytes(), 9903u);
  EXPECT_THROW(buffer.fit_with_room(buffer.most() + 1, "numbers"), Error);
  EXPECT_EQ(device.allocations(), 3u);
}

}  // namespace
}  // namespace steradian::vulkan::kept_buffer_test
