// Shadows on a device: finds what points see of lights behind edges (shaders/shadow_parts.comp). One ray a point says whether that is free
// (shaders/shadow_rays.comp, or the host's: also where a buffer has no room for the triangles, and where a walk through them does not end).
// Points that a thread has no space for a subgroup finds (shaders/shadow_many.comp); those that neither has space for, or is not certain
// about, the host.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "render/cpu/scene_parts.h"
#include "render/cpu/tile_lighting.h"
#include "render/vulkan/compute_program.h"
#include "render/vulkan/kept_buffer.h"
#include "render/vulkan/scene_rays.h"
#include "render/vulkan/tile_shadows.h"

namespace steradian::vulkan {

class Shadows {
 public:
  // What is on the device, for any number of pictures, one after another. The device must stay.
  struct Kept {
    explicit Kept(const Device& device);
    const Device& device;
    ComputeProgram program;
    KeptBuffer groups, answers, parts, states;
  };

  // Whether a device has what a subgroup for one point needs.
  static bool finds_many_edges(const DeviceInfo& device);

  // All must stay; parts: with edges. rays: null for the host's. many_edges: a subgroup each finds what points see behind many edges, for
  // which the host finds it otherwise.
  Shadows(Kept& kept, const SceneParts& parts, TileLighting& host, const SceneRays* rays, bool many_edges);

  // Finds what the first tiles need, as many as buffers have room for, and says how many those are: at least one. Throws Error where one is
  // too many. Calls each(count, work) for work in parallel.
  using Each = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;
  std::size_t find(std::span<TileShadows> tiles, const Each& each);

  // Of the tiles of the last find(), light after light: kTilePixels states each; and the parts' records.
  const Buffer& states() const { return kept_.states.get(); }
  const Buffer& parts() const { return kept_.parts.get(); }

  // Milliseconds of the device so far.
  double time() const { return time_; }
  double rays_time() const { return rays_time_; }
  // Pairs of a surface and a light that the device has answered; of these, that see a part of the light.
  std::uint64_t points() const { return points_; }
  std::uint64_t found() const { return found_; }

 private:
  struct Batch;
  void upload(Batch& batch);
  std::size_t search(Batch& batch);
  void trace(Batch& batch, const Each& each);
  void ask_host(Batch& batch, const Each& each);
  void write_states(Batch& batch, const Each& each);
  Buffer& fitting(KeptBuffer& buffer, std::size_t bytes, const char* what) const;

  std::size_t most_of_buffer() const;  // bytes

  Kept& kept_;
  const RayScene& rays_;
  const SceneRays* const device_rays_;  // null: the host's
  const bool many_edges_;
  TileLighting& host_;
  double time_ = 0, rays_time_ = 0;
  std::uint64_t points_ = 0, found_ = 0;
};

}  // namespace steradian::vulkan
