// A buffer that both the host and shaders read and write.
#pragma once

#include <cstddef>
#include <memory>

#include "device/vulkan/device.h"

namespace steradian::vulkan {

// Main use by the host: memory near the device is slow for the host to read.
enum class BufferUse { host_writes, host_reads };

// Form in which shaders read it: a storage buffer, or also texels of four floats or four bytes (0 to 1), which devices fetch in one go.
enum class BufferForm { storage, texels, colors, numbers };

class Buffer {
 public:
  // Throws Error with the number of bytes that the device does not have.
  Buffer(const Device& device, std::size_t bytes, BufferUse use = BufferUse::host_reads, BufferForm form = BufferForm::storage);
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;
  ~Buffer();

  std::size_t bytes() const { return bytes_; }
  void write(const void* data, std::size_t bytes);
  void read(void* data, std::size_t bytes) const;
  void* mapped() const;  // all of it, as long as the buffer lives

  struct Handles;
  const Handles& handles() const { return *handles_; }

 private:
  std::size_t bytes_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
