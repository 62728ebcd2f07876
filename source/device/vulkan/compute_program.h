// Compute shaders over the same storage buffers. Pipelines are created once for a device and each choice of specialisation constants. A
// run is any number of dispatches, one after another.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "device/vulkan/buffer.h"
#include "device/vulkan/shader_code.h"

namespace steradian::vulkan {

class ComputeProgram {
 public:
  // A shader's entry point is `main`. Its buffers are among the bindings of set 0: `texels` buffers of texels (samplerBuffer), then
  // storage buffers. It may read one uint of push constants. The device must outlive the program.
  ComputeProgram(const Device& device, const std::vector<ShaderCode>& shaders, std::size_t buffers, std::size_t texels = 0);
  ~ComputeProgram();

  // Returns the number of a shader's pipeline in which specialisation constant i is constants[i].
  std::size_t pipeline(std::size_t shader = 0, const std::vector<std::int32_t>& constants = {});

  struct Dispatch {
    std::size_t pipeline = 0;
    std::uint32_t groups_x = 1, groups_y = 1;
    std::uint32_t push = 0;
    // If not null: the numbers of groups are three uints in this buffer, which earlier dispatches may have written.
    const Buffer* groups = nullptr;
    std::size_t groups_at = 0;  // bytes
    std::uint64_t units = 0;    // units of work that the host counts for reports, such as pixels times lights; 0: not counted
  };
  // Records dispatches for the next run, in order, with the buffers by their bindings. Each dispatch sees the writes of those before.
  void record(const std::vector<const Buffer*>& buffers, const std::vector<Dispatch>& dispatches);
  // Runs what `before` has recorded, if it is not null, and then what this program has recorded. Waits until the host can read the
  // results. Throws Error if the device is lost or does not finish. On a device that only compiles, the buffers stay as they are.
  void run(ComputeProgram* before = nullptr);
  // Milliseconds of each dispatch of the last run; empty if the device does not report them.
  const std::vector<double>& times() const { return times_; }
  // Records, runs, and returns times().
  const std::vector<double>& run(const std::vector<const Buffer*>& buffers, const std::vector<Dispatch>& dispatches);

 private:
  struct Handles;
  void prepare_to_run();
  void read_times();

  const Device& device_;
  std::vector<double> times_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
