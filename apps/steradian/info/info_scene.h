// The contents of a scene file, for steradian info SCENE.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "steradian/limits.h"

namespace steradian::app {

// Cameras, lights, materials with their lobes, extensions, unsupported features, and the method that `render --method auto` chooses. Throws
// as load_scene does.
nlohmann::ordered_json scene_facts(const std::string& path, const Limits& limits);

// The same for people: lists as tables, one line per entry.
std::string scene_text(const nlohmann::ordered_json& facts);

}  // namespace steradian::app
