// Shadows on a device: finds what points see of lights behind edges (shaders/shadow_parts.comp). One ray of the host a point says whether
// that is free; points that a thread has no space for, or that it is not certain about, the host finds.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "render/cpu/ray_scene.h"
#include "render/cpu/tile_lighting.h"
#include "render/vulkan/compute_program.h"
#include "render/vulkan/tile_shadows.h"

namespace steradian::vulkan {

class Shadows {
 public:
  // All must stay.
  Shadows(const Device& device, const RayScene& rays, TileLighting& host);

  // Finds what the first tiles need, as many as buffers have room for, and says how many those are: at least one. Throws Error where one is
  // too many. Calls each(count, work) for work in parallel.
  using Each = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;
  std::size_t find(std::span<TileShadows> tiles, const Each& each);

  // Of the tiles of the last find(), light after light: kTilePixels states each; and the parts' records.
  const Buffer& states() const { return *states_; }
  const Buffer& parts() const { return *parts_; }

  // Milliseconds of the device so far.
  double time() const { return time_; }
  // Pairs of a surface and a light that the device has answered; of these, that see a part of the light.
  std::uint64_t points() const { return points_; }
  std::uint64_t found() const { return found_; }

 private:
  struct Batch;
  void upload(const Batch& batch);
  std::size_t search(Batch& batch);
  void trace(Batch& batch, const Each& each);
  void ask_host(Batch& batch, const Each& each);
  void write_states(Batch& batch, const Each& each);
  Buffer& fitting(std::unique_ptr<Buffer>& buffer, std::size_t bytes, const char* what) const;

  const Device& device_;
  const RayScene& rays_;
  TileLighting& host_;
  ComputeProgram program_;
  std::unique_ptr<Buffer> groups_, answers_, parts_, states_;
  double time_ = 0;
  std::uint64_t points_ = 0, found_ = 0;
};

}  // namespace steradian::vulkan
