// render SCENE.svg --frames A..B: pictures of a plane whose bodies move.
#pragma once

#include <string>

#include "render/frame_range.h"
#include "render/render_plane.h"

namespace steradian::app {

struct PlaneFrames {
  FrameRange range;
  std::string edits;  // JSON file: the changes before each frame
};

// Writes the frames that do not exist yet. The frame's number replaces the #s of the output's name. Frame i of an animated drawing is at i
// / fps seconds.
void render_plane_frames(const PlaneRender& job, const PlaneFrames& frames, const PlaneFrameOptions& options, PlaneScene scene);

}  // namespace steradian::app
