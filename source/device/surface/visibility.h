// The triangle that every pixel sees, found by raster.
#pragma once

#include <array>
#include <memory>

#include "device/surface/scene_buffers.h"
#include "render/surface/camera_rays.h"

namespace steradian::vulkan {

// The camera in the layout of shaders.
struct CameraView {
  int width, height;
  Vec3f origin, corner, right, down, forward;  // a pixel's direction is corner + right x + down y, at distance 1 along `forward`

  CameraView(const CameraRays& camera, int width, int height);
};

class Visibility {
 public:
  // Serves any number of pictures. The device must outlive this object.
  explicit Visibility(const Device& device);
  ~Visibility();

  // Records how to find the triangles visible through one position of every pixel. The device's next submission puts them into seen().
  void draw(const SceneBuffers& scene, const CameraView& view, PixelPlace place);
  // Milliseconds of the last drawing, after that submission; 0 if the device does not report them.
  double time() const;
  // By pixel, row by row: 0, or the triangle's number from 1.
  const Buffer& seen() const { return seen_.get(); }

 private:
  void fit(int width, int height);

  struct Handles;
  const Device& device_;
  KeptBuffer seen_;
  int width_ = 0, height_ = 0;  // allocated size
  std::unique_ptr<Handles> handles_;
};

}  // namespace steradian::vulkan
