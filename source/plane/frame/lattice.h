// Light that changes slowly, as what walls send on does: worked out at every eighth pixel of every eighth row, and between them linear.
// Not exact: a cell of 8 x 8 pixels is drawn pixel by pixel where its middle is off by more than a tolerance, or where an outline comes
// near to it.
#pragma once

#include "plane/frame/tiles.h"

namespace steradian::plane {

struct LatticeError {
  double largest = 0;  // that the middle of a cell is off by, of those between whose corners light is linear
  double drawn = 1;    // share of the picture that was drawn pixel by pixel
};

// Adds the frame's light to the picture. tolerance: of the brightest place of the lattice.
LatticeError add_by_lattice(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, double tolerance,
                            Picture& picture, PlaneFrameStats& stats);

}  // namespace steradian::plane
