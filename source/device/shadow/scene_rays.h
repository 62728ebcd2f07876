// The triangles of a scene that cast exact shadows, sorted for the rays of a device.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "device/vulkan/buffer.h"
#include "steradian/scene.h"

namespace steradian::vulkan {

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

}  // namespace steradian::vulkan
