// At most so many area lights, without losing light.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/budget.h"
#include "steradian/scene.h"

namespace steradian::scene {

struct KeptLights {
  std::size_t most = 0;                        // that were to be kept
  std::size_t without_power = 0;               // dropped: without area or radiance
  std::size_t merged = 0;                      // into others of their meshes
  std::size_t dropped = 0;                     // for want of one
  double merged_share = 0, dropped_share = 0;  // of all power
};

// Keeps at most `most` area lights, in their order, and renumbers triangle_lights; those that go have -1.
//
// Every mesh and single light gets a place, the strongest first as far as they go (AreaLight::power); of the others, a mesh gets as many as
// its share of the power, spread evenly over it. The power of a mesh's other polygons goes to the nearest that is kept of it and faces the
// same way (where none does: to the nearest), whose radiance grows. Throws Error where finding those would exceed the budget; path: of the
// file, for its message.
//
// most: none: 256, or as many as there are meshes and single lights that shine, but no more than 65,536: what one pass may add up together
// (RenderOptions::lights) is not to be lost by a file's default.
KeptLights keep_strongest(Scene& scene, std::optional<std::size_t> most, Budget& budget, const std::string& path);

}  // namespace steradian::scene
