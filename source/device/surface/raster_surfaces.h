// The surfaces of a picture, found by a device: a raster pass, then a compute pass over tiles. FrameSurfaces is the CPU's counterpart.
#pragma once

#include <map>
#include <string>

#include "device/direct/direct_light.h"
#include "device/surface/visibility.h"
#include "device/vulkan/compute_program.h"
#include "render/tile/tile.h"
#include "steradian/render.h"

namespace steradian::vulkan {

class RasterSurfaces {
 public:
  // Objects on the device, for any number of pictures in turn. The device must outlive them.
  struct Kept {
    explicit Kept(const Device& device);
    SceneBuffers scene;
    Visibility visibility;
    KeptBuffer view, taken;
    ComputeProgram program;
  };

  // Takes a scene that nothing keeps on the host (what_keeps_on_host). `kept` and the scene must outlive this object. tiles: most tiles of
  // a find; taken: true if the host takes some.
  RasterSurfaces(Kept& kept, const Scene& scene, const MipMaps& maps, const CameraRays& camera, const RenderOptions& options,
                 std::size_t tiles, bool taken);

  // Draws the view through the positions of a primary sample.
  void look(int sample);
  // Writes the surfaces of some tiles, and their emission, in the layout of DirectLight.
  void find(int first_tile, int count, Buffer& surfaces, Buffer& radiance);

  // These functions take the place of a tile among those that find wrote last. is_for_host: true if the host must find the tile, since it
  // shows features that the shaders do not have.
  static bool is_for_host(const Buffer& radiance, std::size_t place);
  // Finds the contents of the tile's squares.
  static void find_squares(const Buffer& radiance, std::size_t place, DirectPass::Tile& tile);
  // Reads the tile's surfaces, as FrameSurfaces::fill writes them, without the background.
  void take(const Buffer& radiance, std::size_t place, SurfaceTile& tile) const;

  // Milliseconds on the device so far, by pass; empty if it does not report them.
  const std::map<std::string, double>& times() const { return times_; }

 private:
  void write_view(PixelPlace place);

  Kept& kept_;
  const Scene& meshes_;
  const CameraView view_;
  const PixelSteps steps_;
  const int samples_;
  const bool smooth_, taken_;
  bool drawn_ = false;  // look() has drawn what find() has not taken yet
  std::map<std::string, double> times_;
};

}  // namespace steradian::vulkan
