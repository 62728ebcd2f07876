// A compute shader with its storage buffers.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/vulkan/buffer.h"

namespace steradian::vulkan {

class ComputePipeline {
 public:
  // The shader's entry point is `main`, its storage buffers are the bindings 0 ... buffers-1 of set 0, and constants[i]
  // becomes its specialisation constant i.
  ComputePipeline(const Device& device, const std::vector<std::uint32_t>& spirv, std::size_t buffers,
                  const std::vector<std::int32_t>& constants = {});
  ~ComputePipeline();

  // Runs `groups` work groups and waits until the results can be read.
  void run(const std::vector<const Buffer*>& buffers, std::uint32_t groups);

 private:
  struct Handles;
  const Device& device_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
