// Frames of scenes with extras: every pixel computes its own sight, from the bodies that may matter to its tile.
#pragma once

#include "core/budget.h"
#include "plane/exact/world.h"
#include "plane/frame/tiles/tiles.h"
#include "steradian/picture.h"

namespace steradian::plane {

// Adds the light that a frame without extras lacks, to some tiles or to all: suns, light shown by mirrors, and light within bodies that
// absorb it. Throws Error, as draw_with_extras does, if its mirrors need more work than the budget has.
void add_extras(const World& world, const PixelGrid& grid, Budget& budget, Picture& picture, const TileSet* only = nullptr);

// Draws the whole light, with layers "moment_x" and "moment_y" if they are requested.
void draw_with_extras(const World& world, const PlaneFrameOptions& options, const PixelGrid& grid, Budget& budget, Picture& picture,
                      const TileSet* only = nullptr);

// Marks the tiles to which the bodies may matter in these two functions. If none of the bodies changes, all other pixels keep their values.
void mark_with_extras(const World& world, const std::vector<std::size_t>& bodies, const PixelGrid& grid, TileSet& tiles);

// Makes the marked tiles black.
void clear_tiles(const TileSet& tiles, Picture& picture);

}  // namespace steradian::plane
