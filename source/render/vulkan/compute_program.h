// Compute shaders over the same storage buffers: pipelines are made once for a device and each choice of specialisation constants, and a
// run is any number of dispatches, one after another.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/vulkan/buffer.h"

namespace steradian::vulkan {

class ComputeProgram {
 public:
  // A shader's entry point is `main`, its buffers are among the bindings of set 0: `texels` buffers of texels (samplerBuffer), then
  // storage buffers; it may read one uint of push constants. The device must stay.
  ComputeProgram(const Device& device, const std::vector<std::span<const std::uint32_t>>& shaders, std::size_t buffers,
                 std::size_t texels = 0);
  ~ComputeProgram();

  // The number of the pipeline of a shader in which specialisation constant i is constants[i].
  std::size_t pipeline(std::size_t shader = 0, const std::vector<std::int32_t>& constants = {});

  struct Dispatch {
    std::size_t pipeline = 0;
    std::uint32_t groups_x = 1, groups_y = 1;
    std::uint32_t push = 0;
    // Not null: the groups are three uints there, which dispatches before may have written.
    const Buffer* groups = nullptr;
    std::size_t groups_at = 0;  // bytes
  };
  // Runs the dispatches in their order, over the buffers by their bindings, each after what the ones before have written, and waits until
  // the host can read the results. Returns the milliseconds of each, empty where the device does not tell. Throws Error when the device is
  // lost or does not end.
  std::vector<double> run(const std::vector<const Buffer*>& buffers, const std::vector<Dispatch>& dispatches);

 private:
  struct Handles;
  const Device& device_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
