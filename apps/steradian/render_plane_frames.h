// render SCENE.svg --frames A..B: pictures of a plane whose bodies move.
#pragma once

#include <string>

#include "render_plane.h"

namespace steradian::app {

struct PlaneFrames {
  int first = 0, last = 0;
  std::string edits;  // JSON file: what changes before which frame
};

// "A..B", 0 <= A <= B.
PlaneFrames plane_frames(const std::string& text);
// Writes the frames: the #s of the output's name become the frame's number.
void render_plane_frames(const PlaneRender& job, const PlaneFrames& frames, PlaneScene scene);

}  // namespace steradian::app
