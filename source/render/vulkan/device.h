// Vulkan devices for compute. The loader is opened at run time: a machine without it has no devices, and nothing else
// changes.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace steradian::vulkan {

struct DeviceInfo {
  std::string name;                // "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string driver;              // driver and its version, or the Vulkan version where the driver does not tell
  bool software;                   // runs on the CPU
  std::string vulkan;              // version that it offers
  std::size_t memory = 0;          // bytes of its largest heap of its own
  std::size_t storage_buffer = 0;  // bytes of the largest that a shader reads
  bool graphics = false;           // draws triangles, too
  std::size_t picture = 0;         // pixels along the longer side of the largest that it draws
  unsigned storage_buffers = 0;    // that a shader may have
  std::size_t texel_buffer = 0;    // texels of the largest buffer of them
  unsigned subgroup = 0;           // threads that run in step
  bool timestamps = false;         // of compute work
  bool broadcasts = false;         // threads that run in step tell each other a value ...
  bool adds = false;               // ... and add theirs up
  std::size_t shared_memory = 0;   // bytes of a work group
};

// Every device of Vulkan 1.2 or later with a compute queue, real ones before software. Empty where there is no loader.
std::vector<DeviceInfo> list_devices();

struct DeviceOptions {
  std::string name;         // part of the device's name, or its place in list_devices(), from 0; empty: the first
  bool validation = false;  // demand the validation layer, and keep what it says
};

// Where the environment names a file by STERADIAN_PIPELINE_CACHE, compiled pipelines are read from it and written to it.
class Device {
 public:
  // Throws Error where there is no such device.
  explicit Device(const DeviceOptions& options = {});
  ~Device();

  const DeviceInfo& info() const { return info_; }
  // Warnings and errors of the validation layer so far.
  const std::vector<std::string>& validation_messages() const;
  // Pieces of memory that were asked of it so far.
  std::size_t allocations() const;

  struct Handles;  // handles.h, for this folder only
  const Handles& handles() const { return *handles_; }

 private:
  std::unique_ptr<Handles> handles_;
  DeviceInfo info_;
};

// Opens a device, or answers with the one that a living SharedDevices has opened before under the same options.
std::shared_ptr<const Device> open_device(const DeviceOptions& options);

// While one lives, open_device() keeps what it opens, with the pipelines made so far. For programs that use devices from one thread at a
// time, as tests do.
class SharedDevices {
 public:
  SharedDevices();
  ~SharedDevices();
  SharedDevices(const SharedDevices&) = delete;
  SharedDevices& operator=(const SharedDevices&) = delete;
};

}  // namespace steradian::vulkan
