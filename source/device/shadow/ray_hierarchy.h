// Triangles, sorted into a hierarchy of boxes that a shader traverses without a stack (shaders/shadow/ray_hierarchy.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "steradian/vector.h"

namespace steradian::vulkan {

struct RayTriangle {
  std::array<Vec3d, 3> corners;  // finite
  std::uint32_t number = 0;      // by which rays report it
};

// Vectors in the layout of shaders/shadow/ray_layout.glsl.
std::vector<std::array<std::uint32_t, 4>> ray_hierarchy(std::vector<RayTriangle> triangles);

// Least number of its vectors: triangles that exceed a buffer need not be sorted.
std::size_t least_of_hierarchy(std::size_t triangles);

}  // namespace steradian::vulkan
