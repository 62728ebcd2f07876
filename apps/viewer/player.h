// Hands what was done, by a person or by a script, to the stage: the meaning of keys, and of a script's words but those of the window
// itself.
#pragma once

#include "keys.h"
#include "script.h"
#include "view_state.h"

namespace steradian::view {

void open_stage(ViewState& state, const std::string& path, const RenderOptions& options);  // throws Error, and leaves the state

void act(ViewState& state, Action action);

// Reads a file again that another program has written, unless that would lose what was changed here: then it says so.
void follow_file(ViewState& state);

// {"set": ...}: a value of the selected light, its material or the picture. Throws Error for what is not known.
void set_value(ViewState& state, const std::string& what, const nlohmann::json& value);

}  // namespace steradian::view
