// load_scene: reads a glTF 2.0 file (.gltf or .glb) into a Scene. docs/scenes.md lists what is read and what is not.
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

// Lights in addition to those of the file. standard: a square light above, in front and to the left; sun: a directional light from there;
// studio: a key, a fill and a rim light. none: no light, even if the file has none.
enum class AddedLight { standard, none, sun, studio };

// The unit of a file's punctual lights in relation to that of its emission. candela: one unit for both, as glTF says. watt: the exporter
// has multiplied candela and lux by 683 lm/W and left the emission in W/(m2 sr); they are divided by that factor. from_generator: watt for
// files that Blender's exporter wrote with that factor, which a warning states.
enum class LightUnits { from_generator, candela, watt };

// The decoded pictures of a file, by their numbers in it. A file that is read repeatedly with other values needs them only once.
struct DecodedPictures {
  std::map<int, Image> images;
};

// The cached meshes of a file in the scene. If the file is read again with other values, meshes whose nodes, vertices and triangles have
// not changed are reused. Made by make_kept_meshes, for one file whose bytes other than its JSON do not change.
struct KeptMeshes;
std::shared_ptr<KeptMeshes> make_kept_meshes();

struct LoadOptions {
  // Number of area lights that remain, strongest first (AreaLight::power); at least 1. None: 256, with capacity for every mesh and single
  // light, up to 65,536.
  std::optional<int> max_lights = {};
  Limits limits{};
  std::string environment = {};     // as load_environment takes it; empty: the file's own (EXT_lights_image_based), if any
  double environment_rotation = 0;  // of the environment about +y, counter-clockwise from above [degrees]
  LightUnits light_units = LightUnits::from_generator;
  double aspect = 16.0 / 9;                        // width over height of the picture that a default camera fills
  std::vector<AddedLight> lights = {};             // empty: standard if the file's own lights are too weak for a picture
  std::shared_ptr<DecodedPictures> pictures = {};  // cached from one reading of the same file to the next; null: none
  std::shared_ptr<KeptMeshes> meshes = {};         // likewise
  bool near_origin = false;                        // moves a scene far from the origin there, before its coordinates become floats
};

// Facts that a file states about itself.
struct FileFacts {
  std::string generator;
  std::vector<std::string> extensions_used, extensions_required, not_supported;
};

struct LoadedScene {
  Scene scene;
  FileFacts file;
  double texture_ms = 0;              // part of the reading: its pictures
  std::vector<std::string> warnings;  // whole sentences, ready to print, about everything that was dropped, defaulted or not supported
  std::vector<int> mesh_nodes;        // by Scene::meshes: the file's node to which it belongs
  std::size_t kept_meshes = 0;        // number of reused meshes (LoadOptions::meshes)
  Vec3d origin{};                     // place of the scene's origin in the file; zero unless near_origin has moved the scene
};

// Reads the file's default scene (the first one if it names none, all root nodes if it has none). A file without lights, or with no other
// light than weak emissive textures on most of its surface (docs/scene-lights.md), gets a default area light. A file without cameras gets a
// camera that frames the scene. A warning states both. Throws Error with file, place in the file and what to do for everything that is
// broken or required but unsupported.
LoadedScene load_scene(const std::string& path, const LoadOptions& options = {});

// The same for the bytes of such a file. path: for messages, and the base of relative paths.
LoadedScene load_scene_from_memory(std::string_view bytes, const std::string& path, const LoadOptions& options = {});

}  // namespace steradian
