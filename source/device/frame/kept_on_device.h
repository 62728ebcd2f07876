// KeptOnDevice: objects on a Vulkan device that are cached from picture to picture: pipelines (the device's), programs, buffers. A picture
// of the same size of an unchanged scene finds everything that it needs there.
#pragma once

#include <memory>
#include <utility>

#include "device/bounce/bounce.h"
#include "device/direct/direct_light.h"
#include "device/shadow/shadows.h"
#include "device/surface/raster_surfaces.h"

namespace steradian::vulkan {

// Creates the object on first use.
template <class Made>
Made& made(std::unique_ptr<Made>& it, const Device& device) {
  if (it == nullptr) it = std::make_unique<Made>(device);
  return *it;
}

struct KeptOnDevice {
  explicit KeptOnDevice(std::shared_ptr<const Device> d) : device(std::move(d)), direct(*device) {}

  const std::shared_ptr<const Device> device;
  DirectPass::Kept direct;
  std::unique_ptr<DeviceShadows::Kept> shadows;
  std::unique_ptr<RasterSurfaces::Kept> raster;
  std::unique_ptr<Bounce> bounce;
};

}  // namespace steradian::vulkan
