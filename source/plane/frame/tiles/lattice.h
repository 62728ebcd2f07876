// Light that changes slowly, like the light that walls reflect. It is computed at every eighth pixel of every eighth row, and is linear in
// between. The result is not exact. A cell of 8 x 8 pixels is drawn pixel by pixel if its middle is off by more than a tolerance, or if an
// outline comes near to it.
#pragma once

#include "plane/frame/tiles/tiles.h"

namespace steradian::plane {

struct LatticeError {
  double largest = 0;  // largest error of a cell's middle, among the cells that are interpolated linearly
  double drawn = 1;    // fraction of the picture that was drawn pixel by pixel
};

// Adds the frame's light to the picture. tolerance: a fraction of the brightest place of the lattice.
LatticeError add_by_lattice(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, double tolerance,
                            Picture& picture, PlaneFrameStats& stats);

}  // namespace steradian::plane
