// render SCENE.glb --frames A..B: pictures of a scene that moves.
#pragma once

#include <optional>
#include <string>

#include "frame_range.h"
#include "steradian/load_scene.h"
#include "steradian/render_cache.h"
#include "steradian/tone.h"

namespace steradian::app {

struct SceneFrames {
  std::string scene, output;  // the #s of the output's name become the frame's number
  FrameRange range;
  double fps = 24;
  std::string animation;  // by name; empty: the first
  bool force = false;     // frames that are there are made again
  LoadOptions load;
  RenderOptions render;
  std::optional<float> exposure;  // none: that of the first frame for all
  ToneCurve tone = ToneCurve::neutral;
  bool multiple_scattering = false;
};

// A frame is there when it is whole: an interrupted sequence goes on with the same command.
void render_scene_frames(SceneFrames job);

}  // namespace steradian::app
