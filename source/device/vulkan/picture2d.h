// A picture in a device's memory. Only files that draw include it.
#pragma once

#include "device/vulkan/handles.h"

namespace steradian::vulkan {

struct Picture2d {
  vk::raii::Image image = nullptr;
  vk::raii::DeviceMemory memory = nullptr;
  vk::raii::ImageView view = nullptr;
};

// Its contents are undefined. Throws Error if the device has no memory for it.
Picture2d make_picture(const Device::Handles& d, vk::Extent2D size, vk::Format format, vk::ImageUsageFlags usage,
                       vk::ImageAspectFlags aspect);

inline vk::Extent2D extent_of(int width, int height) { return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)}; }

}  // namespace steradian::vulkan
