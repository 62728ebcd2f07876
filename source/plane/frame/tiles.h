// The pixels of a frame, tile by tile.
#pragma once

#include "plane/frame/scene.h"
#include "steradian/picture.h"

namespace steradian::plane {

struct PixelGrid {
  Vec2d origin, step;  // the picture's corner, a pixel's size
  int width, height;
  Vec2d at(int x, int y) const { return {origin.x + step.x * (x + 0.5), origin.y + step.y * (y + 0.5)}; }
};

// Fills the picture's pixels, and the counts of the statistics.
void render_tiles(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture,
                  PlaneFrameStats& stats);

}  // namespace steradian::plane
