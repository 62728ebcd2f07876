// Frames on a Vulkan device: all of a picture's light, or none. The host finds the lights that may reach surfaces, and their occluders. The
// device finds the visible parts and adds the light.
#pragma once

#include <memory>
#include <string>

#include "device/vulkan/device.h"
#include "steradian/render.h"
#include "steradian/render_cache.h"

namespace steradian::vulkan {

// The first option for which no device has a part: estimates by samples, and many lights summed together. Empty: a device may have all.
std::string lack_of_devices(const Scene& scene, const RenderOptions& options);

// Choice of who finds the surfaces that pixels see. automatic: the device, unless it is software (slower at that than the host) or
// something keeps the host at it.
enum class SurfacesBy { automatic, host, device };

// Choice of who traces the rays of the bounce's shadow map. automatic: the device, unless it is software, slower at that than the host.
enum class RaysBy { automatic, host, device };

// Buffers and pipelines are created once, for any number of frames of a scene.
class DeviceFrame {
 public:
  // Scene and options must outlive the frame. surfaces: `device` is a UsageError if something keeps the host at it. device: null for the
  // one that the options name. cache: stores sorted data and objects on that device for the next frame; null: nothing is stored. Throws
  // UsageError for pictures that the host renders alone, and for options that this back end does not support yet. Throws Error if there is
  // no such device.
  DeviceFrame(const Scene& scene, const RenderOptions& options, std::shared_ptr<const Device> device = nullptr,
              SurfacesBy surfaces = SurfacesBy::automatic, RaysBy rays = RaysBy::automatic, RenderCache* cache = nullptr);
  ~DeviceFrame();

  // The reason why this device cannot do all of the picture; empty: it can.
  const std::string& lacks() const;

  // Throws UsageError if the device lacks something. Sets stats of this frame alone. Returns early, with an unfinished picture, when
  // options.stop becomes true.
  Picture render(RenderStats* stats = nullptr);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace steradian::vulkan
