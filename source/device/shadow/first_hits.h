// First hits of a shadow map's rays, found by a device (shaders/bounce_rays.comp).
#pragma once

#include <memory>
#include <utility>

#include "render/bounce/shadow_map.h"
#include "device/vulkan/compute_program.h"
#include "device/shadow/scene_rays.h"

namespace steradian::vulkan {

class FirstHits final : public indirect::FirstHits {
 public:
  // Takes a scene in which all shadow casters cast exactly.
  explicit FirstHits(std::shared_ptr<const SceneRays> scene);

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
  std::unique_ptr<Buffer> rays_, met_;
  double time_ = 0;
};

}  // namespace steradian::vulkan
