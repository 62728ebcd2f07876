// The scene of a file as bakes take it, and the map's file beside a baked scene.
#pragma once

#include <string>

#include "steradian/load_scene.h"

namespace steradian::bake {

// Only the file's own lights count, and the scene lies near the origin. Throws Error for a scene without light.
LoadedScene load_to_bake(const std::string& path, LoadOptions options);

// The name of the map: the scene's, with .exr.
std::string map_beside(const std::string& baked_scene);

}  // namespace steradian::bake
