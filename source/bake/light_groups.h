// Light groups: lights that are switched and dimmed together, each with a light map of its own. The maps add up to that of all lights.
#pragma once

#include <string>
#include <vector>

#include "bake/bake.h"

namespace steradian::bake {

struct NamedLights {
  std::string name;
  std::vector<std::uint8_t> area, punctual;  // by light of the scene: 1 if it belongs to the group
  bool environment = false;
};

inline constexpr const char* kOtherLights = "others";

// A group for each name: the lights whose names begin with it, each in the first group that names it. The last group has all other lights
// and the environment, if there are any. Throws Error(place, ...) for a name that no light has.
std::vector<NamedLights> light_groups(const Scene& scene, const std::vector<std::string>& names, const std::string& place);

// The scene in the light of one group: the others are dark, and their shapes stay.
Scene in_light_of(const Scene& scene, const NamedLights& group);

// Bakes a map for each group, and their sum. Charts, texels and files are those of bake_map. For textures only.
LightMap bake_light_groups(const Scene& scene, const std::vector<NamedLights>& groups, const BakeOptions& options, const std::string& place,
                           Budget& budget, BakeStats& stats);

}  // namespace steradian::bake
