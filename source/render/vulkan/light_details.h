// What stands behind lights beside their records, as shaders read it: textures (shaders/light_textures.glsl) and measured profiles
// (shaders/light_profiles.glsl).
#pragma once

#include <map>
#include <vector>

#include "render/vulkan/light_records.h"

namespace steradian::vulkan {

class LightDetails {
 public:
  // Of the first lights as far as there is room.
  LightDetails(const std::vector<PackLight>& lights, std::size_t most_vectors);

  // Whether nothing of the light is missing here.
  bool has(const PackLight& light) const;
  // Where a light's begin; kNoDetails where it has none.
  std::ptrdiff_t first_of(const PackLight& light) const;
  const std::vector<Vec4Floats>& values() const { return values_; }

 private:
  std::map<const void*, std::size_t> firsts_;  // of a texture or profile
  std::vector<Vec4Floats> values_;
};

}  // namespace steradian::vulkan
