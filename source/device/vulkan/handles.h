// The Vulkan objects behind Device. Only files of the back end and the window include it: vulkan.hpp takes seconds to compile.
#pragma once

#define VK_NO_PROTOTYPES  // every function comes from the loader at run time
#include <vulkan/vulkan_raii.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/fingerprint.h"
#include "device/vulkan/device.h"
#include "steradian/error.h"

namespace steradian::vulkan {

// The pipelines created so far from shaders over the same buffers.
struct Pipelines {
  vk::raii::DescriptorSetLayout set_layout = nullptr;
  vk::raii::PipelineLayout layout = nullptr;
  std::map<std::pair<std::size_t, std::vector<std::int32_t>>, std::size_t> numbers;  // by shader and constants
  std::vector<vk::raii::Pipeline> made;
  std::vector<std::size_t> reports;  // of the pipelines made, among the device's
};

struct Device::Handles {
  vk::raii::Context context;
  vk::raii::Instance instance = nullptr;
  vk::raii::DebugUtilsMessengerEXT messenger = nullptr;
  vk::raii::PhysicalDevice physical = nullptr;
  vk::raii::Device device = nullptr;
  std::uint32_t queue_family = 0;
  vk::raii::Queue queue = nullptr;
  vk::raii::CommandPool commands = nullptr;
  vk::raii::PipelineCache pipeline_cache = nullptr;
  std::string cache_key, cache_file;  // the file is empty: none
  std::vector<char> cached;           // its contents when the device was opened
  float timestamp_period = 0;         // nanoseconds per tick
  // The key distinguishes programs: the numbers of their buffers and the fingerprints of their shaders' words. Entries live as long as the
  // device, since pipelines take longer to create than pictures.
  mutable std::map<std::vector<Fingerprint>, Pipelines> pipelines;
  bool has_statistics = false;  // the driver reports statistics of pipelines, and somebody asked for them
  mutable std::vector<PipelineReport> reports;
  std::vector<std::string> messages;
  mutable std::size_t allocations = 0, submissions = 0;
  mutable std::vector<vk::CommandBuffer> ahead;  // recorded commands that the next submission takes first
  mutable bool hangs = false;                    // submitted work has not ended, and still uses its objects

  vk::PipelineCreateFlags pipeline_flags() const {
    return has_statistics ? vk::PipelineCreateFlagBits::eCaptureStatisticsKHR : vk::PipelineCreateFlags();
  }

  vk::raii::DeviceMemory allocate(const vk::MemoryAllocateInfo& info) const {
    ++allocations;
    return device.allocateMemory(info);
  }

  // For destructors: releases objects, without destroying them, that a hanging device may still use.
  template <class Made>
  void leave(std::unique_ptr<Made>& made) const {
    if (hangs) static_cast<void>(made.release());
  }
};

// Adds the reports of a pipeline's shaders, in the order of its stages, and their statistics if the device has them.
void report(const Device::Handles& d, const vk::raii::Pipeline& pipeline, std::vector<PipelineReport> shaders);

inline double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Runs f; a failure of Vulkan becomes an Error at `place` that says what was being done.
template <class F>
auto checked(const std::string& place, const std::string& doing, F f) {
  try {
    return f();
  } catch (const vk::OutOfDeviceMemoryError&) {
    throw Error(place, doing + ": the device has no memory left", "close what else uses it, choose another --device, or --backend cpu");
  } catch (const vk::DeviceLostError&) {
    throw Error(place, doing + ": the device was lost",
                "try again, choose another --device, or --backend cpu; the driver's log may say why");
  } catch (const vk::SystemError& e) {
    throw Error(place, doing + ": " + e.what());
  }
}
template <class F>
auto checked(const Device& device, const std::string& doing, F f) {
  return checked("Vulkan device '" + device.info().name + "'", doing, f);
}

inline vk::raii::ShaderModule module_of(const vk::raii::Device& device, std::span<const std::uint32_t> spirv) {
  return device.createShaderModule({{}, spirv.size_bytes(), spirv.data()});
}

// Submits the commands to the device at once, after those that wait ahead of it, and waits until they are done. work: what a hanging device
// did not finish, for the error.
inline void submit_and_wait(const Device& device, std::vector<vk::CommandBuffer> commands, const vk::raii::Fence& done, const char* work) {
  constexpr std::uint64_t longest = 300'000'000'000;  // ns
  const Device::Handles& d = device.handles();
  commands.insert(commands.begin(), d.ahead.begin(), d.ahead.end());
  d.ahead.clear();
  d.device.resetFences(*done);
  d.queue.submit(vk::SubmitInfo({}, {}, commands, {}), *done);
  ++d.submissions;
  if (d.device.waitForFences(*done, VK_TRUE, longest) != vk::Result::eSuccess) {
    d.hangs = true;
    throw Error("Vulkan device '" + device.info().name + "'", std::string("did not finish ") + work + " within five minutes",
                "ask for a smaller picture, choose another --device, or --backend cpu");
  }
}

// Milliseconds between neighbouring timestamps among the first `count`.
inline std::vector<double> times_between(const Device& device, const vk::raii::QueryPool& stamps, std::uint32_t count) {
  using Flag = vk::QueryResultFlagBits;
  const auto ticks =
      stamps.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t), Flag::e64 | Flag::eWait);
  std::vector<double> times;
  for (std::uint32_t i = 1; i < count; ++i)
    times.push_back(static_cast<double>(ticks.second[i] - ticks.second[i - 1]) * static_cast<double>(device.handles().timestamp_period) *
                    1e-6);
  return times;
}

}  // namespace steradian::vulkan
