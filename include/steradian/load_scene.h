// load_scene: a glTF 2.0 file (.gltf or .glb) to a Scene. What is read and what is not: docs/scenes.md.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "steradian/limits.h"
#include "steradian/scene.h"

namespace steradian {

// Lights beside those of the file. standard: a square light above, in front and to the left; sun: a directional light from
// there; studio: a key, a fill and a rim light. none: not even where the file has none.
enum class AddedLight { standard, none, sun, studio };

// The unit of a file's punctual lights beside that of its emission. candela: one unit for both, as glTF says. watt: the exporter has
// multiplied candela and lux by 683 lm/W and left the emission in W/(m2 sr); they are divided by it. from_generator: watt for files
// that Blender's exporter wrote with that factor, which is said in a warning.
enum class LightUnits { from_generator, candela, watt };

// The pictures of a file as they were decoded, by their numbers in it: a file that is read again and again with other values needs them
// once.
struct DecodedPictures {
  std::map<int, Image> images;
};

// The meshes of a file as they stood in the scene: of a file that is read again with other values, those whose nodes, vertices and
// triangles have not changed are taken as they are. Made by make_kept_meshes, for one file whose bytes beside its JSON stay as they are.
struct KeptMeshes;
std::shared_ptr<KeptMeshes> make_kept_meshes();

struct LoadOptions {
  // Area lights kept, strongest first (AreaLight::power); at least 1. None: 256, and room for every mesh and single light, up to 65,536.
  std::optional<int> max_lights = {};
  Limits limits{};
  std::string environment = {};  // as load_environment takes it; empty: the file's own (EXT_lights_image_based), if any
  LightUnits light_units = LightUnits::from_generator;
  double aspect = 16.0 / 9;                        // width over height of the picture that a default camera fills
  std::vector<AddedLight> lights = {};             // empty: standard where the file's own lights are too weak for a picture
  std::shared_ptr<DecodedPictures> pictures = {};  // kept from one reading of the same file to the next; null: none
  std::shared_ptr<KeptMeshes> meshes = {};         // likewise
};

// What a file says of itself.
struct FileFacts {
  std::string generator;
  std::vector<std::string> extensions_used, extensions_required, not_supported;
};

struct LoadedScene {
  Scene scene;
  FileFacts file;
  double texture_ms = 0;              // of the reading: its pictures
  std::vector<std::string> warnings;  // whole sentences, ready to print: what was dropped, defaulted or not supported
  std::vector<int> mesh_nodes;        // by Scene::meshes: the file's node that it is of
  std::size_t kept_meshes = 0;        // that were taken as they stood (LoadOptions::meshes)
};

// Reads the file's default scene (the first one if it names none, all root nodes if it has none). A file
// without lights, or with no other light than weak emissive textures on most of its surface (docs/scenes.md), gets a default area light,
// one without cameras a camera that frames the scene; both are said in a warning. Throws Error with file, place in the file and what to do
// for everything that is broken or required but unsupported.
LoadedScene load_scene(const std::string& path, const LoadOptions& options = {});

// The same for the bytes of such a file. path: for messages, and the place that other files are relative to.
LoadedScene load_scene_from_memory(std::string_view bytes, const std::string& path, const LoadOptions& options = {});

}  // namespace steradian
