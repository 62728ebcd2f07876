// The surfaces of a picture found by a device: raster, then a compute pass over tiles. FrameSurfaces is what the CPU has in its place.
#pragma once

#include <map>
#include <string>

#include "render/vulkan/compute_program.h"
#include "render/vulkan/direct_light.h"
#include "render/vulkan/visibility.h"
#include "steradian/render.h"

namespace steradian::vulkan {

class RasterSurfaces {
 public:
  // Of a scene that nothing keeps on the host (what_keeps_on_host). The device must stay.
  RasterSurfaces(const Device& device, const Scene& scene, const CameraRays& camera, const RenderOptions& options);

  // Looks through the places of a primary sample.
  void look(int sample);
  // Writes the surfaces of some tiles, and what they emit, as DirectLight reads them.
  void find(int first_tile, int count, Buffer& surfaces, Buffer& radiance);

  // What there is in the squares of a tile that was found, by its place among them.
  static void find_squares(const Buffer& radiance, std::size_t place, DirectLight::Tile& tile);

  // Milliseconds on the device so far, by pass; empty where it does not tell.
  const std::map<std::string, double>& times() const { return times_; }

 private:
  void write_view(PixelPlace place);

  const CameraView view_;
  const PixelSteps steps_;
  const int samples_;
  const SceneBuffers scene_;
  Visibility visibility_;
  Buffer view_buffer_;
  ComputeProgram program_;
  std::map<std::string, double> times_;
};

}  // namespace steradian::vulkan
