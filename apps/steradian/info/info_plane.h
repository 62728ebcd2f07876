// The contents of a drawing, for steradian info DRAWING.svg.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "steradian/limits.h"

namespace steradian::app {

// Lights, suns, occluders, and what is left out with the reason. Throws as load_plane_scene does.
nlohmann::ordered_json plane_facts(const std::string& path, const Limits& limits);

}  // namespace steradian::app
