// A storage buffer that both the host and shaders read and write.
#pragma once

#include <cstddef>
#include <memory>

#include "render/vulkan/device.h"

namespace steradian::vulkan {

class Buffer {
 public:
  Buffer(const Device& device, std::size_t bytes);
  Buffer(Buffer&&) noexcept;
  ~Buffer();

  std::size_t bytes() const { return bytes_; }
  void write(const void* data, std::size_t bytes);
  void read(void* data, std::size_t bytes) const;

  struct Handles;
  const Handles& handles() const { return *handles_; }

 private:
  std::size_t bytes_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
