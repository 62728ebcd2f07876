// Vulkan devices for compute. The loader is opened at run time: a machine without it has no devices, and nothing else changes.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "device/vulkan/pipeline_report.h"

namespace steradian::vulkan {

struct DeviceInfo {
  std::string name;                // "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string driver;              // driver and its version, or the Vulkan version if the driver does not report it
  bool software;                   // runs on the CPU
  std::string vulkan;              // supported version
  std::size_t memory = 0;          // bytes of its largest device-local heap
  std::size_t storage_buffer = 0;  // bytes of the largest one that a shader reads
  bool graphics = false;           // also draws triangles
  std::size_t picture = 0;         // pixels along the longer side of the largest picture that it draws
  unsigned storage_buffers = 0;    // most that a shader may have
  std::size_t texel_buffer = 0;    // texels of the largest texel buffer
  unsigned subgroup = 0;           // threads that run in step
  bool timestamps = false;         // for compute work
  bool broadcasts = false;         // threads that run in step can exchange a value ...
  bool adds = false;               // ... and sum their values
  bool int64 = false;              // shaders have whole numbers of 64 bits
  std::size_t shared_memory = 0;   // bytes of a work group
  bool runs = true;                // false: a driver without its hardware, which compiles shaders and runs nothing
};

// All devices of Vulkan 1.2 or later with a compute queue: hardware, then software, then what runs nothing. Empty if there is no loader.
std::vector<DeviceInfo> list_devices();

// Bytes of a storage buffer that Vulkan guarantees.
inline constexpr std::size_t kGuaranteedBuffer = std::size_t{128} << 20;

// Throws Error, with the device's name, if the device lacks something, such as so many storage buffers for a shader of `what`.
void check_device(const DeviceInfo& device, std::size_t buffers, const std::string& what);

struct DeviceOptions {
  std::string name;         // part of the device's name, or its place in list_devices(), from 0; empty: the first
  bool validation = false;  // require the validation layer, and record its messages
  // Pipelines are made with the compiler's statistics, and nothing runs: buffers keep what the host writes. For reports.
  bool only_compiles = false;
  // Extensions of the instance that a window system needs. With them the device can present, and its pipelines do not stay.
  std::vector<std::string> window_extensions = {};
};

// A Vulkan device. Compiled pipelines stay from run to run in the user's cache folder, or in the folder that the
// environment variable STERADIAN_PIPELINE_CACHE names; if it is empty, they do not stay (core/cache_file.h).
class Device {
 public:
  // Throws Error if there is no such device, or if it runs nothing but should.
  explicit Device(const DeviceOptions& options = {});
  ~Device();

  const DeviceInfo& info() const { return info_; }
  bool only_compiles() const { return only_compiles_; }
  // The pipelines made so far, in their order.
  const std::vector<PipelineReport>& pipelines() const;
  // Warnings and errors of the validation layer so far.
  const std::vector<std::string>& validation_messages() const;
  // Numbers of memory allocations, and of submissions of work, so far.
  std::size_t allocations() const;
  std::size_t submissions() const;

  struct Handles;  // handles.h, for the back end and the window only
  const Handles& handles() const { return *handles_; }

 private:
  std::unique_ptr<Handles> handles_;
  DeviceInfo info_;
  bool only_compiles_ = false;
};

// Opens a device, or returns the one that a living SharedDevices has already opened with the same options.
std::shared_ptr<const Device> open_device(const DeviceOptions& options);

// While one lives, open_device() caches the devices that it opens, with the pipelines created so far. For programs that use devices from
// one thread at a time, such as tests.
class SharedDevices {
 public:
  SharedDevices();
  ~SharedDevices();
  SharedDevices(const SharedDevices&) = delete;
  SharedDevices& operator=(const SharedDevices&) = delete;
};

}  // namespace steradian::vulkan
