// Drawings as scenes, for the frames of one drawing: the public functions are in steradian/plane.h.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "steradian/plane.h"

namespace steradian::plane::svg {

// Elements that are taken for backdrops, by their number in the drawing.
using Backdrops = std::map<std::size_t, PlaneLeftOut::Why>;

struct LoadedDrawing {
  PlaneSvg svg;
  Backdrops backdrops;
};

// Reads a drawing. `backdrops`: those of another frame, which remain; null: judged here. Throws as load_plane_scene.
LoadedDrawing read_drawing(const std::string& text, const std::string& name, const Limits& limits, const Backdrops* backdrops = nullptr);

}  // namespace steradian::plane::svg
