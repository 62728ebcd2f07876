// The pipelines of a picture, for steradian info SCENE --pipelines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "steradian/load_scene.h"
#include "steradian/render.h"

namespace steradian::app {

// Nothing runs on the device. Throws Error if there is no device, or if no device renders the picture.
nlohmann::ordered_json pipeline_facts(const std::string& path, const Limits& limits, const RenderOptions& options);

}  // namespace steradian::app
