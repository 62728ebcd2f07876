// State shared by the window, its panel and its keys.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "display.h"
#include "drawing/drawing.h"
#include "session.h"

namespace steradian::view {

struct ViewState {
  std::unique_ptr<Stage> stage;
  Session* session = nullptr;       // the stage if it is a scene in space
  DrawingStage* drawing = nullptr;  // the stage if it is a drawing of the plane

  float exposure = 0;
  ToneCurve tone = ToneCurve::neutral;
  bool exposure_known = false;  // automatic until the first picture, then fixed
  bool panel = true, help = false;
  bool playing = false;  // the animation runs
  bool split = false, error_map = false;
  float split_at = 0.5f;    // fraction of the width
  float error_most = 0.1f;  // value of the error map shown as white
  std::string other_method = "reference";
  std::string scene_name, picture_name;       // to save as
  std::deque<std::vector<PassTime>> history;  // passes of the latest pictures
  std::string screen;                         // that shows the window: "OpenGL", or "Vulkan" and its device
  bool quit = false;

  // The displayed picture; recomputed if the picture or one of these values changed.
  Display display;
  bool display_wanted = true;
};

// Runs work that can fail because of the file, the machine or the user's input. The window shows the error.
template <class Work>
void attempt(ViewState& state, Work work) {
  try {
    work();
  } catch (const std::exception& e) {
    state.stage->say(e.what());
  }
}

// Chooses the second method for a split screen or an error map, or none, according to the state.
void choose_other(ViewState& state);

// Functions that draw with Dear ImGui, between its NewFrame and its Render.
void draw_overlay(ViewState& state, double scale);  // handles and marks; scale: picture pixels over ImGui's
void draw_panel(ViewState& state);
void draw_help(ViewState& state);
void draw_message(const ViewState& state);  // shows the error, if there is one

}  // namespace steradian::view
