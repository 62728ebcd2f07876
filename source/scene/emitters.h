// Emissive meshes to polygon lights.
#pragma once

#include "core/budget.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Appends a light for every flat patch of every mesh whose material emits, and sets Mesh::triangle_lights.
// Returns how many triangles were left out for having no area. Throws Error where that would
// exceed the budget; path: of the file, for its message.
std::size_t add_emitters(Scene& scene, Budget& budget, const std::string& path);

// Keeps the `most` strongest area lights, in their order, drops those without power, and renumbers
// triangle_lights.
struct KeptLights {
  std::size_t without_power = 0, too_many = 0;
  double share = 1;  // of all power that is kept
};
KeptLights keep_strongest(Scene& scene, std::size_t most);

}  // namespace steradian::scene
