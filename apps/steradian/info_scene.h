// What a scene file holds, for steradian info SCENE.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "steradian/limits.h"

namespace steradian::app {

// Cameras, lights, materials with their lobes, extensions, what is not supported, and which method `render --method auto` takes.
// Throws as load_scene does.
nlohmann::ordered_json scene_facts(const std::string& path, const Limits& limits);

// The same to be read by people: lists as tables, a line each.
std::string scene_text(const nlohmann::ordered_json& facts);

}  // namespace steradian::app
