// EXT_lights_image_based: the environment of a glTF scene.
#pragma once

#include <memory>

#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_textures.h"
#include "steradian/environment.h"

namespace steradian::scene {

// Null if the scene has none. Only the sharpest of the file's maps is read, and converted to equirectangular. The irradiance is the file's.
std::shared_ptr<const Environment> read_image_based_light(const GltfDocument& document, GltfTextures& textures);

}  // namespace steradian::scene
