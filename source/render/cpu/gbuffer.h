// Fills the G-buffer of a tile by tracing primary rays.
#pragma once

#include "render/cpu/camera_rays.h"
#include "render/cpu/ray_scene.h"
#include "render/cpu/tile.h"

namespace steradian {

struct TileArea {
  int x, y, width, height;  // in the picture; at most kTileSide wide and high
};

// One primary sample per pixel, at `place` within the pixel. tile.radiance becomes the emission.
void fill_tile(const Scene& scene, const RayScene& rays, const CameraRays& camera, TileArea area, PixelPlace place,
               SurfaceTile& tile);

}  // namespace steradian
