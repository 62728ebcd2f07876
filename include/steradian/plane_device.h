// Frames of the plane on a Vulkan device: the device sums the light of every tile, with one thread a pixel. The CPU builds the lists of
// lights and blockers, except for those of most round lights, which the device builds. Needs the layer `plane_vulkan`
// (steradian::plane_vulkan).
#pragma once

#include <memory>
#include <string>

#include "steradian/plane.h"

namespace steradian {

namespace vulkan {
class Device;
}

struct PlaneDeviceStats {
  double lists_ms = 0, upload_ms = 0, resolve_ms = 0;  // on the host: lists of tiles, their upload, sums into the picture
  double device_ms = 0;                                // total waiting time
  double making_lists_ms = 0;                          // the device's own clock, 0 if it has none: lists of round lights,
  double disks_ms = 0, cuts_ms = 0, arcs_ms = 0;       // round lights, disks and edges, arcs
  std::size_t tiles = 0;                               // tiles that had light to sum
  std::size_t tiles_of_cpu = 0;                        // of these, drawn by the CPU: more intervals in a light than a thread stores
  std::size_t lights_listed = 0;                       // round lights whose lists the device built
  std::size_t bytes = 0;                               // size of the buffers on the device
};

class PlaneDevice {
 public:
  // device: part of a device's name or its number, as `steradian info` lists them; empty: the first. Throws Error if there is none.
  explicit PlaneDevice(const std::string& device = {});
  explicit PlaneDevice(std::shared_ptr<const vulkan::Device> device);
  ~PlaneDevice();
  PlaneDevice(PlaneDevice&&) noexcept;
  PlaneDevice& operator=(PlaneDevice&&) noexcept;

  const std::string& name() const;
  // The same as render_plane: every pixel is within 1e-5 of the query. Buffers and pipelines stay for later frames. Throws UsageError for
  // methods other than exact and for moments.
  Picture render(const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);
  void render_into(Picture& picture, const PlaneWorld& world, const PlaneFrameOptions& options, PlaneFrameStats* stats = nullptr);

  const PlaneDeviceStats& stats() const;  // statistics of the last frame

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace steradian
