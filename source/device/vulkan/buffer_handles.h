// The Vulkan objects behind Buffer, for the back end and the window only.
#pragma once

#include "device/vulkan/buffer.h"
#include "device/vulkan/handles.h"

namespace steradian::vulkan {

struct Buffer::Handles {
  vk::raii::Buffer buffer = nullptr;
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::BufferView texels = nullptr;
  std::vector<char> only_host;  // the contents on a device that only compiles: there is no buffer
  void* mapped = nullptr;
  const Device::Handles* device = nullptr;
};

}  // namespace steradian::vulkan
