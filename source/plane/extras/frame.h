// Frames of scenes with extras: every pixel by a sight of its own, from what may matter to its tile.
#pragma once

#include "core/budget.h"
#include "plane/exact/world.h"
#include "plane/frame/tiles.h"
#include "steradian/picture.h"

namespace steradian::plane {

// Adds what a frame without extras lacks: what suns send, what mirrors show, and the light within bodies that take it in.
// Throws Error, as draw_with_extras does, where its mirrors ask for more work than the budget has.
void add_extras(const World& world, const PixelGrid& grid, Budget& budget, Picture& picture);

// Draws all of it, with layers "moment_x" and "moment_y" if they are asked for.
void draw_with_extras(const World& world, const PlaneFrameOptions& options, const PixelGrid& grid, Budget& budget, Picture& picture);

}  // namespace steradian::plane
