#include "steradian/error.h"
#include "steradian/load_scene.h"
#include "targets.h"

namespace steradian::fuzz {

void gltf(Input input) {
  try {
    // In a folder that is not there: what the file names beside it is not found.
    load_scene_from_memory({reinterpret_cast<const char*>(input.data()), input.size()}, "/nowhere/scene.gltf", {.limits = kLimits});
  } catch (const Error&) {
  }
}

}  // namespace steradian::fuzz
