// The materials of emissive meshes, whose lights shine alike.
#pragma once

#include <cstddef>
#include <vector>

#include "steradian/scene.h"

namespace steradian::scene {

// The file's material of a light of an emissive mesh; -1 for other lights.
int material_of_light(const Scene& scene, std::size_t light);
// All lights of an emissive material. They shine alike.
std::vector<std::size_t> lights_of_material(const Scene& scene, int material);

}  // namespace steradian::scene
