// EXT_lights_image_based: the environment that a glTF scene brings.
#pragma once

#include <memory>

#include "scene/gltf_document.h"
#include "scene/gltf_textures.h"
#include "steradian/environment.h"

namespace steradian::scene {

// Null where the scene has none. Of the file's maps the sharpest alone is read, and made equirectangular; the irradiance is the file's.
std::shared_ptr<const Environment> read_image_based_light(const GltfDocument& document, GltfTextures& textures);

}  // namespace steradian::scene
