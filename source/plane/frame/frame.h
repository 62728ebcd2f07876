// A frame of the plane, with a parameter that fills its tiles.
#pragma once

#include <functional>

#include "plane/frame/scene.h"
#include "plane/frame/tiles/tiles.h"
#include "steradian/picture.h"

namespace steradian::plane {

// Adds the light of a prepared scene to the picture, which has the grid's size, and fills in the statistics.
using FillTiles = std::function<void(const FrameScene& frame, const PlaneFrameOptions& options, const PixelGrid& grid, Picture& picture,
                                     PlaneFrameStats& stats)>;

// Like render_plane_into. The method is the exact one, without moments.
void render_plane_with(const FillTiles& fill, Picture& result, const PlaneWorld& world, const PlaneFrameOptions& options,
                       PlaneFrameStats* stats);

}  // namespace steradian::plane
