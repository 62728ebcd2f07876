// render SCENE.svg --frames A..B: pictures of a plane whose bodies move.
#pragma once

#include <string>

#include "frame_range.h"
#include "render_plane.h"

namespace steradian::app {

struct PlaneFrames {
  FrameRange range;
  std::string edits;  // JSON file: what changes before which frame
};

// Writes the frames that are not there yet: the #s of the output's name become the frame's number. Frame i of a drawing that moves is at
// i / fps seconds.
void render_plane_frames(const PlaneRender& job, const PlaneFrames& frames, const PlaneFrameOptions& options, PlaneScene scene);

}  // namespace steradian::app
