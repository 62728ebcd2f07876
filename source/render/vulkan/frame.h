// Frames on a Vulkan device: the host finds the surfaces and the lights that may reach them, as for the CPU; the device lights them.
#pragma once

#include <memory>

#include "render/vulkan/device.h"
#include "steradian/render.h"

namespace steradian::vulkan {

// Buffers and pipelines are made once, for any number of frames of a scene.
class Frame {
 public:
  // Scene and options must stay. device: null for the one that the options name. Throws UsageError for options that this back end does
  // not have yet, Error where there is no such device.
  Frame(const Scene& scene, const RenderOptions& options, std::shared_ptr<const Device> device = nullptr);
  ~Frame();

  // Sets stats of this frame alone. Returns early, with what it has, when options.stop becomes true.
  Picture render(RenderStats* stats = nullptr);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace steradian::vulkan
