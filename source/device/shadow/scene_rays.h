// Rays on a device: the sorted triangles of a scene, and the first hits of a shadow map's rays.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "device/vulkan/buffer.h"
#include "device/vulkan/compute_program.h"
#include "render/bounce/shadow_map.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

// The triangles of a scene that cast exact shadows, sorted for the rays of a device.

class SceneRays {
 public:
  // Returns null if they exceed a buffer.
  static std::shared_ptr<const SceneRays> of(std::shared_ptr<const Device> device, const Scene& scene);

  const Device& device() const { return *device_; }
  const Buffer& hierarchy() const { return hierarchy_; }

  // Triangle with a number in the hierarchy.
  struct Triangle {
    std::uint32_t mesh, triangle;
  };
  Triangle triangle(std::uint32_t number) const { return triangles_[number]; }

 private:
  SceneRays(std::shared_ptr<const Device> device, std::size_t bytes, std::vector<Triangle> triangles);

  const std::shared_ptr<const Device> device_;
  Buffer hierarchy_;
  const std::vector<Triangle> triangles_;
};

// Returns true if all shadow casters cast exactly: no cut-outs, which a device's rays do not support.
bool all_cast_exactly(const Scene& scene);

// First hits of a shadow map's rays, found by a device (shaders/bounce/bounce_rays.comp).

class DeviceFirstHits final : public indirect::FirstHits {
 public:
  // Takes a scene in which all shadow casters cast exactly.
  explicit DeviceFirstHits(std::shared_ptr<const SceneRays> scene);

  std::size_t most() const override;
  indirect::MapRay* rays(std::size_t count) override;
  void find(std::size_t count) override;
  indirect::FirstHit hit(std::size_t ray) const override;

  const SceneRays* scene() const { return scene_.get(); }
  // Milliseconds on the device since the last call; 0 if it does not report them.
  double take_time() { return std::exchange(time_, 0); }

 private:
  const std::shared_ptr<const SceneRays> scene_;
  ComputeProgram program_;
  KeptBuffer rays_, met_;
  double time_ = 0;
};

}  // namespace steradian::vulkan
