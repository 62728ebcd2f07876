// Shadows on a device: a subgroup per point finds the visible parts of lights behind edges (shaders/shadow_parts.comp). One ray per point
// tests that the part is unoccluded, on the device (shaders/shadow_rays.comp) or on the host. The host's rays also serve if a buffer has no
// capacity for the triangles, or if a traversal does not end. The host handles points that exceed the capacity or are uncertain.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>

#include "device/shadow/scene_rays.h"
#include "device/shadow/tile_shadows.h"
#include "device/vulkan/buffer.h"
#include "device/vulkan/compute_program.h"
#include "render/frame/tile_lighting.h"
#include "render/surface/ray_scene.h"

namespace steradian::vulkan {

class Shadows {
 public:
  // Objects on the device, for any number of pictures in turn. The device must outlive them.
  struct Kept {
    explicit Kept(const Device& device);
    const Device& device;
    ComputeProgram program;
    KeptBuffer groups, answers, parts, states;
  };

  // Returns true if a device supports a subgroup per point.
  static bool has(const DeviceInfo& device);

  // All arguments must outlive this object; parts: with edges. rays: null for the host's.
  Shadows(Kept& kept, const SceneParts& parts, TileLighting& host, const SceneRays* rays);

  // Finds the shadows of the first tiles, as many as buffers have capacity for, and returns their number: at least one. Throws Error if
  // one is too many. Calls each(count, work) for work in parallel.
  using Each = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;
  std::size_t find(std::span<TileShadows> tiles, const Each& each);

  // Results for the tiles of the last find(), light after light: kTilePixels states each; and the parts' records.
  const Buffer& states() const { return kept_.states.get(); }
  const Buffer& parts() const { return kept_.parts.get(); }

  // Milliseconds on the device so far.
  double time() const { return time_; }
  double rays_time() const { return rays_time_; }
  // Pairs of a surface and a light that the device has answered, and how many of these see a part of the light.
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
  const SceneRays* const device_rays_;  // null: the host's rays
  TileLighting& host_;
  double time_ = 0, rays_time_ = 0;
  std::uint64_t points_ = 0, found_ = 0;
};

}  // namespace steradian::vulkan
