// Frames of scenes with extras: every pixel by a sight of its own, from what may matter to its tile.
#pragma once

#include "core/budget.h"
#include "plane/exact/world.h"
#include "plane/frame/tiles.h"
#include "steradian/picture.h"

namespace steradian::plane {

// Adds what a frame without extras lacks: what suns send, what mirrors show, and the light within bodies that take it in; to some tiles, or
// to all. Throws Error, as draw_with_extras does, where its mirrors ask for more work than the budget has.
void add_extras(const World& world, const PixelGrid& grid, Budget& budget, Picture& picture, const TileSet* only = nullptr);

// Draws all of it, with layers "moment_x" and "moment_y" if they are asked for.
void draw_with_extras(const World& world, const PlaneFrameOptions& options, const PixelGrid& grid, Budget& budget, Picture& picture,
                      const TileSet* only = nullptr);

// Marks the tiles to which bodies may matter in what these two draw: without a change to any of them, a tile's pixels stay what they are.
void mark_with_extras(const World& world, const std::vector<std::size_t>& bodies, const PixelGrid& grid, TileSet& tiles);

// Black where tiles are marked.
void clear_tiles(const TileSet& tiles, Picture& picture);

}  // namespace steradian::plane
