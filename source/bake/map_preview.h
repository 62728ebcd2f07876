// A scene that shows its light map in any viewer: unlit materials with the map as their colour, without the surfaces' own textures.
#pragma once

#include "bake/bake.h"
#include "scene/gltf/gltf_file.h"

namespace steradian::bake {

// baked: the file with the map (add_light_map). The brightest twentieth of the texels is white. Surfaces that shine keep their materials.
scene::GltfFile map_preview(const scene::GltfFile& baked, const LightMap& map);

}  // namespace steradian::bake
