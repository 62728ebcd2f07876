// A scene's file with its light map: texture coordinates of the map for each lit primitive, and the map as a picture in the file.
//
// The file says what its maps are: extras.steradian.lightMap = {exr, width, height, encoding, maps: [{group, texture, range, intensity}]}.
// Each primitive that shows them has extras.steradian.lightMap = {texCoord} (docs/bake.md). Meshes that several nodes show become a mesh
// for each node, because each has its own light. Materials, and meshes without light, stay as they are.
#pragma once

#include <string>

#include "bake/bake.h"
#include "bake/encoding.h"
#include "scene/gltf/gltf_file.h"
#include "steradian/load_scene.h"
#include "steradian/picture.h"

namespace steradian::bake {

// loaded: the scene that was read from the file, before it was baked. exr: name of the map's file beside the scene, for its extras.
//
// Light at vertices becomes the attribute _IRRADIANCE of three floats, and extras.steradian.irradiance = "_IRRADIANCE".
void add_light_map(scene::GltfFile& file, const LoadedScene& loaded, const LightMap& map, const std::string& exr, const Limits& limits,
                   MapEncoding encoding = MapEncoding::rgbm);

// The map as a picture: irradiance, and layers for its error and its groups of lights.
Picture picture_of(const LightMap& map);

}  // namespace steradian::bake
