// Lights as shaders read them: records, and the details beside them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "render/lights/light_list.h"

namespace steradian::vulkan {

// Lights in the layout of shaders: shaders/lights/lights.glsl.

using Vec4Floats = std::array<float, 4>;

// Properties of the light with a number.
struct LightRecord {
  int kind = 0;              // constant of shaders/layout.glsl
  bool ball = false;         // an ellipsoid of three equal axes
  bool textured = false;     // its lobes need its mean
  bool profiled = false;     // by direction alone
  float deviation2 = 0;      // as in the shaders
  Vec3f middle{};            // reference point of their distances to a light
  float near_distance2 = 0;  // beyond it, a point is not near the rim; 0: a light without one
};

inline constexpr std::ptrdiff_t kNoDetails = -1;

struct LightRecords {
  std::vector<LightRecord> lights;
  std::vector<Vec4Floats> values;    // kRecord each
  std::vector<Vec4Floats> vertices;  // w: 1 if the vertex continues a contour, which begins with its last vertex

  std::uint32_t add(const PackLight& light, std::ptrdiff_t details);  // returns its number; details: first vector (LightDetails)
  void keep(std::size_t lights, std::size_t vertices);                // keeps the first ones
};

// Details of lights beside their records, in the layout of shaders: textures (shaders/lights/light_textures.glsl) and profiles
// (shaders/lights/light_profiles.glsl).
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
