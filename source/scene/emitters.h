// Emissive meshes to lights.
#pragma once

#include "core/budget.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Appends a light for every ball, tube or else flat patch of every mesh whose material emits, and sets Mesh::triangle_lights.
// Returns how many triangles were left out for having no area. Throws Error where that would
// exceed the budget; path: of the file, for its message.
std::size_t add_emitters(Scene& scene, Budget& budget, const std::string& path);

}  // namespace steradian::scene
