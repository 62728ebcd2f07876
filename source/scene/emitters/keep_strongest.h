// Limits the number of area lights without losing light.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/budget.h"
#include "steradian/scene.h"

namespace steradian::scene {

// Lights that were merged into others, and their fraction of all power.
struct MergedLights {
  std::size_t count = 0;
  double share = 0;
};

struct KeptLights {
  std::size_t most = 0;           // the most lights to keep
  std::size_t without_power = 0;  // dropped: no area or no radiance
  std::size_t dropped = 0;        // dropped because no other light could take their power
  double dropped_share = 0;       // fraction of all power
  MergedLights merged;            // merged into other lights of their meshes
  std::vector<MergedLights> of;   // the same by mesh; empty: none
};

// Keeps at most `most` area lights, in their order, and renumbers triangle_lights; removed lights have -1.
//
// Every mesh and every single light gets one place, the strongest first as far as the places go (AreaLight::power). The other places go to
// the meshes by their fraction of the power, spread evenly over each mesh. The power of a mesh's other polygons goes to the nearest kept
// polygon of that mesh that faces the same way. If none does, it goes to the nearest. The radiance of that polygon grows. Throws Error if
// this search would exceed the budget. path: the file's path, for its message.
//
// most: none: 256, or as many as there are meshes and single lights that emit, but no more than 65,536. A default for files shall not drop
// lights that one pass may add up together (RenderOptions::lights).
KeptLights keep_strongest(Scene& scene, std::optional<std::size_t> most, Budget& budget, const std::string& path);

}  // namespace steradian::scene
