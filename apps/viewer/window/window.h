// The window of `steradian view`: a GLFW window with Dear ImGui over a texture that holds the picture.
#pragma once

#include <optional>
#include <string>

#include "steradian/render.h"
#include "steradian/tone.h"

namespace steradian::view {

struct WindowOptions {
  std::string scene;
  RenderOptions render;
  std::optional<float> exposure;  // none: automatic
  ToneCurve tone = ToneCurve::neutral;
  std::string script;  // a file of script.h to play; empty: none
  std::string record;  // a file to record the input in; empty: none
  bool panel = true;
};

// Runs until the window is closed. Throws Error if there is no display, or the scene cannot be read.
void run_window(const WindowOptions& options);

}  // namespace steradian::view
