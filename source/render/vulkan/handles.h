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
  std::vector<std::string> messages;
};

// Runs f; a failure of Vulkan becomes an Error that says what was being done.
template <class F>
auto checked(const char* doing, F f) {
  try {
    return f();
  } catch (const vk::SystemError& e) {
    throw Error("Vulkan", std::string(doing) + ": " + e.what());
  }
}

}  // namespace steradian::vulkan
