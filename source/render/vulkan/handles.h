// The Vulkan objects behind Device. Only files of this folder include it: vulkan.hpp takes seconds to compile.
#pragma once

#define VK_NO_PROTOTYPES  // every function comes from the loader at run time
#include <vulkan/vulkan_raii.hpp>

#include "render/vulkan/device.h"
#include "steradian/error.h"

namespace steradian::vulkan {

struct Device::Handles {
  vk::raii::Context context;
  vk::raii::Instance instance = nullptr;
  vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
  vk::raii::PhysicalDevice physical = nullptr;
  vk::raii::Device device = nullptr;
  std::uint32_t queue_family = 0;
  vk::raii::Queue queue = nullptr;
  vk::raii::CommandPool commands = nullptr;
  float timestamp_period = 0;  // nanoseconds of a tick
  std::vector<std::string> messages;
};

// Runs f; a failure of Vulkan becomes an Error that says what was being done.
template <class F>
auto checked(const char* doing, F f) {
  try {
    return f();
  } catch (const vk::OutOfDeviceMemoryError&) {
    throw Error("Vulkan", std::string(doing) + ": the device has no memory left", "close what else uses it, or choose another --device");
  } catch (const vk::DeviceLostError&) {
    throw Error("Vulkan", std::string(doing) + ": the device was lost", "try again; a driver's log may say why");
  } catch (const vk::SystemError& e) {
    throw Error("Vulkan", std::string(doing) + ": " + e.what());
  }
}

}  // namespace steradian::vulkan
