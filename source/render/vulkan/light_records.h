// Lights as shaders read them: shaders/lights.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/cpu/light_list.h"

namespace steradian::vulkan {

using Vec4Floats = std::array<float, 4>;

// What is behind a light's number.
struct LightRecord {
  int kind = 0;              // of shaders/layout.glsl
  bool ball = false;         // an ellipsoid of three equal axes
  int mean = 0;              // whose lobes ask for one: kTextureMean, kProfileMean
  bool profiled = false;     // by direction alone
  int edges = 0;             // most edges that the horizon leaves of a polygon; 0 of other lights
  float deviation2 = 0;      // as the shaders have it
  Vec3f middle{};            // from where they measure how far a light is
  float near_distance2 = 0;  // beyond, a point is not near the rim; 0: a light without one
};

inline constexpr std::ptrdiff_t kNoDetails = -1;

struct LightRecords {
  std::vector<LightRecord> lights;
  std::vector<Vec4Floats> values;    // kRecord each
  std::vector<Vec4Floats> vertices;  // w: 1 where the vertex goes on with a contour, which begins with its last one

  std::uint32_t add(const PackLight& light, std::ptrdiff_t details);  // its number; details: where those begin (LightDetails)
  void keep(std::size_t lights, std::size_t vertices);                // the first ones
};

}  // namespace steradian::vulkan
