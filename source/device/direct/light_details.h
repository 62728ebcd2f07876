// Details of lights beside their records, in the layout of shaders: textures (shaders/light_textures.glsl) and measured profiles
// (shaders/light_profiles.glsl).
#pragma once

#include <map>
#include <vector>

#include "device/direct/light_records.h"

namespace steradian::vulkan {

class LightDetails {
 public:
  // Stores the details of the first lights as far as the capacity allows.
  LightDetails(const std::vector<PackLight>& lights, std::size_t most_vectors);

  // Returns true if the light's details are complete here.
  bool has(const PackLight& light) const;
  // First vector of a light's details; kNoDetails if it has none.
  std::ptrdiff_t first_of(const PackLight& light) const;
  const std::vector<Vec4Floats>& values() const { return values_; }

 private:
  std::map<const void*, std::size_t> firsts_;  // by texture or profile
  std::vector<Vec4Floats> values_;
};

}  // namespace steradian::vulkan
