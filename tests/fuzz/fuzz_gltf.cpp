#include "scene/gltf/gltf_animation.h"
#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "targets.h"

namespace steradian::fuzz {

void gltf(Input input) {
  const std::string_view bytes(reinterpret_cast<const char*>(input.data()), input.size());
  constexpr const char* kPath = "/nowhere/scene.gltf";  // files beside it are not found
  try {
    load_scene_from_memory(bytes, kPath, {.limits = kLimits});
  } catch (const Error&) {
  }
  try {
    scene::GltfFile file = scene::gltf_file_from_memory(bytes, kPath, kLimits);
    for (const scene::GltfAnimation& animation : read_animations(file, kLimits)) {
      file.json = json_at(file.json, animation, animation.duration / 2);
      load_scene_from_memory(glb_bytes(file), kPath, {.limits = kLimits});
    }
  } catch (const Error&) {
  }
}

}  // namespace steradian::fuzz
