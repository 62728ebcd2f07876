// Converts glTF materials to SurfaceMaterial.
#pragma once

#include <vector>

#include "scene/gltf/gltf_textures.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Names what a material asks for and the renderer lacks.
std::vector<SurfaceMaterial> read_materials(const GltfDocument& document, GltfTextures& textures);

// Reads a lobe in the form of `steradian eval`: {"brdf": "phong", "exponent": 50}. Unknown keys are an Error.
Material read_lobe(const JsonCursor& lobe);

}  // namespace steradian::scene
