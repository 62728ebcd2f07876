// Converts emissive meshes to lights.
#pragma once

#include "core/budget.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Appends one light for every ball, tube or flat patch of every mesh whose material emits, and sets Mesh::triangle_lights. Returns the
// number of triangles skipped because they have no area. Throws Error where the lights would exceed the budget. path: the file's path, for
// the message.
std::size_t add_emitters(Scene& scene, Budget& budget, const std::string& path);

}  // namespace steradian::scene
