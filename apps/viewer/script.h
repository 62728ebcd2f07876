// A script of user input: one JSON object per line. A window records and plays such scripts.
//
//   {"press": "left", "at": [400, 300]}   {"move": [420, 300]}   {"release": "left"}
//   {"drag": "left", "from": [400, 300], "to": [500, 260], "steps": 10}      "shift": true with press and drag
//   {"click": [400, 300]}   {"wheel": 2, "at": [400, 300]}   {"key": "Ctrl+Z"}   {"select": "star"}
//   {"set": "intensity", "value": 9}      of the selected light; "color", "size", "type", ... of docs/view-scripts.md
//   {"wait": "settled"}   {"wait": "picture"}   {"wait": 0.5}   {"time": "first picture"}   the last prints the seconds since the start
//   {"shot": "a.png"}   {"picture": "a.exr"}   {"save": "scene.glb"}
//   {"resize": [800, 450]}   {"minimise": true}   {"restore": true}   {"open": "other.glb"}   {"quit": true}
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "steradian/vector2.h"

namespace steradian::view {

enum class ScriptWord {
  press,
  move,
  release,
  click,
  wheel,
  key,
  select,
  set,
  wait,
  time,
  shot,
  picture,
  save,
  resize,
  minimise,
  restore,
  open,
  quit
};

struct ScriptEvent {
  ScriptWord word = ScriptWord::quit;
  std::string text;   // button, key, name, path; set: name of the value
  Vec2d at;           // press, move, click, wheel; resize: the size
  double number = 0;  // wheel: steps; wait: seconds, or kSettled or kPicture
  bool shift = false;
  nlohmann::json value;  // set
};

inline constexpr double kSettled = -1, kPicture = -2;  // wait: until the final picture is done; until there is any picture

// Expands a drag into its press, moves and release. Throws Error with file, line and the valid commands.
std::vector<ScriptEvent> read_script(const std::string& text, const std::string& path);
std::string script_line(const ScriptEvent& event);

}  // namespace steradian::view
