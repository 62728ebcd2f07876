// What the window, its panel and its keys share.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "display.h"
#include "drawing.h"
#include "session.h"

namespace steradian::view {

struct ViewState {
  std::unique_ptr<Stage> stage;
  Session* session = nullptr;  // the stage where it is a scene in space
  Drawing* drawing = nullptr;  // where it is one of the plane

  float exposure = 0;
  ToneCurve tone = ToneCurve::neutral;
  bool exposure_known = false;  // automatic until the first picture, then the same for all
  bool panel = true, help = false;
  bool playing = false;  // the animation runs
  bool split = false, error_map = false;
  float split_at = 0.5f;    // share of the width
  float error_most = 0.1f;  // of the map: white
  std::string other_method = "reference";
  std::string scene_name, picture_name;       // to save as
  std::deque<std::vector<PassTime>> history;  // of the last pictures
  bool quit = false;

  // Of the picture that is shown; made again where the picture or one of these changed.
  Display display;
  bool display_wanted = true;
};

// Runs what can fail for the file, the machine or the user's words: what is wrong is said in the window.
template <class Work>
void attempt(ViewState& state, Work work) {
  try {
    work();
  } catch (const std::exception& e) {
    state.stage->say(e.what());
  }
}

// The second method of a split screen or an error map, or none, as the state says.
void choose_other(ViewState& state);

// Draws with Dear ImGui, between its NewFrame and its Render.
void draw_overlay(ViewState& state, double scale);  // handles and marks; scale: picture pixels over ImGui's
void draw_panel(ViewState& state);
void draw_help(ViewState& state);
void draw_message(const ViewState& state);  // what is wrong, if something is

}  // namespace steradian::view
