#include "keys.h"

#include <algorithm>
#include <cctype>

namespace steradian::view {
namespace {

constexpr KeyBinding kBindings[] = {
    {"F1", Action::help, "this help"},
    {"Tab", Action::panel, "panel on and off"},
    {"1", Action::gizmo_move, "handles that move"},
    {"2", Action::gizmo_turn, "handles that turn"},
    {"3", Action::gizmo_scale, "handles that scale"},
    {"W", Action::fly, "fly forward"},
    {"A", Action::fly, "fly to the left"},
    {"S", Action::fly, "fly back"},
    {"D", Action::fly, "fly to the right"},
    {"Q", Action::fly, "fly down"},
    {"E", Action::fly, "fly up"},
    {"F", Action::frame_selected, "look at what is selected, or at the middle"},
    {"Home", Action::reset_camera, "the file's camera"},
    {"L", Action::add_light, "add a light above what is looked at"},
    {"Delete", Action::remove, "delete the selected light"},
    {"Escape", Action::deselect, "select nothing"},
    {"Ctrl+Z", Action::undo, "undo"},
    {"Ctrl+Y", Action::redo, "redo"},
    {"Ctrl+Shift+Z", Action::redo, "redo"},
    {"Ctrl+S", Action::save_scene, "save the scene under the panel's name"},
    {"Ctrl+P", Action::save_picture, "save the picture under the panel's name"},
    {"F5", Action::reload, "read the file again"},
    {"C", Action::split, "split screen with a second method"},
    {"M", Action::error_map, "map of the difference to it"},
    {"B", Action::bounce, "light between surfaces, on and off"},
    {"P", Action::paint, "brush on and off: a left drag paints wanted light"},
    {"G", Action::fit, "fit the lights to the strokes, or stop"},
    {"Backspace", Action::remove_stroke, "remove the last stroke"},
    {"Space", Action::play, "play and pause the animation"},
    {"Ctrl+Q", Action::quit, "close the window"},
};

bool same(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::span<const KeyBinding> key_bindings() { return kBindings; }

std::optional<Action> action_of(std::string_view key) {
  for (const KeyBinding& binding : kBindings)
    if (same(binding.key, key)) return binding.action;
  return {};
}

}  // namespace steradian::view
