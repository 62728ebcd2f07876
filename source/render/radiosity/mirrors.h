// Mirrors: the surfaces that narrow lobes show to the viewer, one for each surface of a tile.
#pragma once

#include "core/mip_maps.h"
#include "render/surface/camera_rays.h"
#include "render/surface/gbuffer.h"

namespace steradian::radiosity {

class Mirrors {
 public:
  // All but the pixels' steps must outlive this object.
  Mirrors(const Scene& scene, const RayScene& rays, const MipMaps& maps, const PixelSteps& steps);

  // Surfaces that a tile's mirrors show.
  struct Image {
    SurfaceTile tile;
    TileVector weight;   // fraction of their light that the mirrors reflect
    TilePlane distance;  // length of the way from the viewer
  };
  // Finds the image. distance: of the tile's surfaces from the viewer, along the way. Returns false if it shows nothing.
  bool find(const SurfaceTile& tile, const TilePlane& distance, Image& image) const;

 private:
  const Scene& scene_;
  const RayScene& rays_;
  const MipMaps& maps_;
  const float pixel_;  // size of a pixel at distance 1
};

}  // namespace steradian::radiosity
