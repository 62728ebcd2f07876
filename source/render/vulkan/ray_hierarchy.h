// Triangles, sorted into a hierarchy of boxes that a shader walks without a stack (shaders/ray_hierarchy.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "steradian/vector.h"

namespace steradian::vulkan {

struct RayTriangle {
  std::array<Vec3d, 3> corners;  // finite
  std::uint32_t number = 0;      // by which rays name it
};

// Vectors as shaders/ray_layout.glsl has them.
std::vector<std::array<std::uint32_t, 4>> ray_hierarchy(const std::vector<RayTriangle>& triangles);

// How many it has at least: what is too many for a buffer need not be sorted.
std::size_t least_of_hierarchy(std::size_t triangles);

}  // namespace steradian::vulkan
