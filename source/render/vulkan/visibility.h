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
  // For any number of pictures. The device must stay.
  explicit Visibility(const Device& device);
  ~Visibility();

  // Finds what is seen through one place of every pixel, and returns when it stands in seen(). Returns its milliseconds.
  double draw(const SceneBuffers& scene, const CameraView& view, PixelPlace place);
  // By pixel, row by row: 0, or the triangle's number from 1.
  const Buffer& seen() const { return seen_.get(); }

 private:
  void fit(int width, int height);

  struct Handles;
  const Device& device_;
  KeptBuffer seen_;
  int width_ = 0, height_ = 0;  // that there is room for
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
