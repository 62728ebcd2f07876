// Passes the actions of a person or a script to the stage. Defines the meaning of keys, and of the script's commands except those of the
// window itself.
#pragma once

#include "keys.h"
#include "script.h"
#include "view_state.h"

namespace steradian::view {

void open_stage(ViewState& state, const std::string& path, const RenderOptions& options);  // throws Error, and leaves the state unchanged

void act(ViewState& state, Action action);

// Reads a file again that another program has written. If that would lose changes made here, it only shows a message.
void follow_file(ViewState& state);

// {"set": ...}: sets a value of the selected light, its material or the picture. Throws Error for unknown values.
void set_value(ViewState& state, const std::string& what, const nlohmann::json& value);

}  // namespace steradian::view
