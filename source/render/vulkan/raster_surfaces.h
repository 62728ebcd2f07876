// The surfaces of a picture found by a device: raster, then a compute pass over tiles. FrameSurfaces is what the CPU has in its place.
#pragma once

#include <map>
#include <string>

#include "render/cpu/tile.h"
#include "render/vulkan/compute_program.h"
#include "render/vulkan/direct_light.h"
#include "render/vulkan/visibility.h"
#include "steradian/render.h"

namespace steradian::vulkan {

class RasterSurfaces {
 public:
  // What is on the device, for any number of pictures, one after another. The device must stay.
  struct Kept {
    explicit Kept(const Device& device);
    SceneBuffers scene;
    Visibility visibility;
    KeptBuffer view, taken;
    ComputeProgram program;
  };

  // Of a scene that nothing keeps on the host (what_keeps_on_host). What is kept and the scene must stay. tiles: most of a find; taken:
  // whether the host takes some.
  RasterSurfaces(Kept& kept, const Scene& scene, const MipMaps& maps, const CameraRays& camera, const RenderOptions& options,
                 std::size_t tiles, bool taken);

  // Looks through the places of a primary sample.
  void look(int sample);
  // Writes the surfaces of some tiles, and what they emit, as DirectLight reads them.
  void find(int first_tile, int count, Buffer& surfaces, Buffer& radiance);

  // Of the tiles that find has written last, by their places among them. Whether the host must find the tile, since it shows what the
  // shaders do not have.
  static bool is_for_host(const Buffer& radiance, std::size_t place);
  // What there is in its squares.
  static void find_squares(const Buffer& radiance, std::size_t place, DirectLight::Tile& tile);
  // Its surfaces, as FrameSurfaces::fill has them; without the background.
  void take(const Buffer& radiance, std::size_t place, SurfaceTile& tile) const;

  // Milliseconds on the device so far, by pass; empty where it does not tell.
  const std::map<std::string, double>& times() const { return times_; }

 private:
  void write_view(PixelPlace place);

  Kept& kept_;
  const Scene& meshes_;
  const CameraView view_;
  const PixelSteps steps_;
  const int samples_;
  const bool taken_;
  std::map<std::string, double> times_;
};

}  // namespace steradian::vulkan
