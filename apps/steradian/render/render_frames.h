// render SCENE.glb --frames A..B: pictures of an animated scene.
#pragma once

#include <optional>
#include <string>

#include "part.h"
#include "render/frame_range.h"
#include "steradian/load_scene.h"
#include "steradian/render_cache.h"
#include "steradian/tone.h"

namespace steradian::app {

struct SceneFrames {
  std::string scene, output;  // the frame's number replaces the #s of the output's name
  FrameRange range;
  Part part;  // renders every part.count-th frame
  double fps = 24;
  std::string animation;  // by name; empty: the first
  bool force = false;     // existing frames are rendered again
  LoadOptions load;
  RenderOptions render;
  std::optional<float> exposure;  // none: the first frame's exposure for all
  ToneCurve tone = ToneCurve::neutral;
  bool multiple_scattering = false;
};

// A frame's file exists only when it is complete. So the same command continues an interrupted sequence.
void render_scene_frames(SceneFrames job);

}  // namespace steradian::app
