// The actions of the window's keys: one list for the window, its help on F1 and scripts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace steradian::view {

enum class Action {
  help,
  panel,
  gizmo_move,
  gizmo_turn,
  gizmo_scale,
  frame_selected,
  reset_camera,
  add_light,
  remove,
  deselect,
  undo,
  redo,
  save_scene,
  save_picture,
  reload,
  split,
  error_map,
  bounce,
  play,
  paint,
  fit,
  remove_stroke,
  fly,
  quit,
};

struct KeyBinding {
  std::string_view key;  // "Ctrl+Z"
  Action action;
  std::string_view help;
};

std::span<const KeyBinding> key_bindings();
// Ignores case.
std::optional<Action> action_of(std::string_view key);

}  // namespace steradian::view
