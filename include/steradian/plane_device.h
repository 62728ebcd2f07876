// Frames of the plane on a Vulkan device: the light of every tile is added up there, a thread a pixel. The lists of lights and blockers
// are the CPU's own, but for those of most round lights, which the device makes. Needs the layer `plane_vulkan` (steradian::plane_vulkan).
#pragma once

#include <memory>
#include <string>

#include "steradian/plane.h"

namespace steradian {

namespace vulkan {
class Device;
}

struct PlaneDeviceStats {
  double lists_ms = 0, upload_ms = 0, resolve_ms = 0;  // of the host: lists of tiles, their way to the device, sums into the picture
  double device_ms = 0;                                // all that was waited for
  double making_lists_ms = 0;                          // the device's own clock, 0 where it has none: lists of round lights,
  double disks_ms = 0, cuts_ms = 0, arcs_ms = 0;       // round lights, disks and edges, arcs
  std::size_t tiles = 0;                               // that had light to add up
  std::size_t tiles_of_cpu = 0;                        // of these, drawn by the CPU: more intervals in a light than a thread keeps
  std::size_t lights_listed = 0;                       // round lights whose lists the device made
  std::size_t bytes = 0;                               // of buffers on the device
};

class PlaneDevice {
 public:
  // device: part of a device's name or its number, as `steradian info` lists them; empty: the first. Throws Error where there is none.
  explicit PlaneDevice(const std::string& device = {});
  explicit PlaneDevice(std::shared_ptr<const vulkan::Device> device);
  ~PlaneDevice();
  PlaneDevice(PlaneDevice&&) noexcept;
  PlaneDevice& operator=(PlaneDevice&&) noexcept;

  const std::string& name() const;
  // As render_plane: every pixel within 1e-5 of the query. Buffers and pipelines stay for the frames that follow. Throws UsageError for
  // methods other than exact and for moments.
  Picture render(const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);
  void render_into(Picture& picture, const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);

  const PlaneDeviceStats& stats() const;  // of the last frame

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace steradian
