// AllLight: the light that surfaces send to each other, added to the tiles of a picture (docs/bounces.md).
#pragma once

#include <memory>
#include <vector>

#include "render/certificate/bounce_bounds.h"
#include "render/frame/frame_surfaces.h"
#include "render/radiosity/gather.h"
#include "render/radiosity/mirror/mirror_image.h"
#include "render/radiosity/patch_solver.h"
#include "render/tile/pass_clock.h"

namespace steradian {

class AllLight {
 public:
  // add_direct: adds the direct light of a tile's surfaces, also where other surfaces of the tile's pixels are being lit. Rays and surfaces
  // must outlive this object.
  // bounds: null without RenderOptions::bound.
  AllLight(std::shared_ptr<const radiosity::PatchLight> patches, std::unique_ptr<const certificate::BounceBounds> bounds,
           const FrameSurfaces& surfaces, const RenderOptions& options, radiosity::AddDirect add_direct);

  // Makes the layers "indirect", "bounce_error" and "bounce_bound", and with RenderOptions::bound "lower" and "upper".
  static void begin(Picture& picture, const RenderOptions& options);
  // Place of a tile's surfaces in the picture.
  struct Seen {
    TileArea area;
    int sample, layer;         // layer: number of the pixels' surfaces before them, along all ways
    const TileVector* shares;  // fraction of their light that arrives at the camera; null: all
    float weight;              // of the sample
  };
  // Adds the light of other surfaces to a tile's radiance and to the layers.
  void add(SurfaceTile& tile, const Seen& seen, Picture& picture);

  // Blurs what mirrors show by their lobes, when all tiles have been added.
  void finish(Picture& picture);

  void report(int threads, RenderStats& stats, const Picture& picture) const;

 private:
  void add_bounds(const SurfaceTile& tile, const TileVector& light, const Seen& seen, Picture& picture) const;
  void gather(SurfaceTile& tile, int sample, radiosity::Gather::Asked asked, TileVector& light, TileVector& error) const;
  void add_mirrored(const SurfaceTile& tile, const TilePlane& distance, const Seen& seen, TileVector& light, TileVector& error);
  TilePlane follow_mirrors(radiosity::Mirrors& mirrors, std::uint64_t seed, int sample, int depth, TileVector& light,
                           TileVector& error) const;

  const int width_, bounces_, reflections_;
  const bool preview_;
  const Vec3f eye_;
  PassClock clock_{"bounces"};
  const std::shared_ptr<const radiosity::PatchLight> patches_;
  const std::unique_ptr<const certificate::BounceBounds> bounds_;
  const radiosity::Gather gather_;
  const radiosity::PatchesInLobes in_lobes_;
  std::vector<radiosity::MirrorImage> mirror_images_;  // by layer of surfaces
  const FrameSurfaces& surfaces_;
  const radiosity::AddDirect add_direct_;
};

}  // namespace steradian
