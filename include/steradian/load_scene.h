// load_scene: a glTF 2.0 file (.gltf or .glb) to a Scene. What is read and what is not: docs/scenes.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "steradian/limits.h"
#include "steradian/scene.h"

namespace steradian {

// Lights beside those of the file. standard: a square light above, in front and to the left; sun: a directional light from
// there; studio: a key, a fill and a rim light. none: not even where the file has none.
enum class AddedLight { standard, none, sun, studio };

struct LoadOptions {
  int max_lights = 256;  // area lights kept, strongest first (AreaLight::power); at least 1
  Limits limits{};
  std::vector<AddedLight> lights = {};  // empty: standard where the file's own lights are too weak for a picture
};

struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;  // whole sentences, ready to print: what was dropped, defaulted or not supported
};

// Reads the file's default scene (the first one if it names none, all root nodes if it has none). A file
// without lights, or with no other light than weak emissive textures on most of its surface (docs/scenes.md), gets a default area light,
// one without cameras a camera that frames the scene; both are said in a warning. Throws Error with file, place in the file and what to do
// for everything that is broken or required but unsupported.
LoadedScene load_scene(const std::string& path, const LoadOptions& options = {});

// The same for the bytes of such a file. path: for messages, and the place that other files are relative to.
LoadedScene load_scene_from_memory(std::string_view bytes, const std::string& path, const LoadOptions& options = {});

}  // namespace steradian
