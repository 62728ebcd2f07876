// Which triangle every pixel sees, by raster.
#pragma once

#include <array>
#include <memory>

#include "render/cpu/camera_rays.h"
#include "render/vulkan/scene_buffers.h"

namespace steradian::vulkan {

// The camera as shaders have it.
struct CameraView {
  int width, height;
  Vec3f origin, corner, right, down, forward;  // a pixel's direction is corner + right x + down y, at distance 1 along `forward`

  CameraView(const CameraRays& camera, int width, int height);
};

class Visibility {
 public:
  // The scene must stay.
  Visibility(const Device& device, const SceneBuffers& scene, const CameraView& view);
  ~Visibility();

  // Finds what is seen through one place of every pixel, and returns when it stands in seen(). Returns its milliseconds.
  double draw(PixelPlace place);
  // By pixel, row by row: 0, or the triangle's number from 1.
  const Buffer& seen() const { return seen_; }

 private:
  struct Handles;
  const Device& device_;
  const SceneBuffers& scene_;
  const CameraView view_;
  Buffer seen_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
