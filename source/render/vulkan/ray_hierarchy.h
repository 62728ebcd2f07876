// The triangles that cast exact shadows, sorted into a hierarchy of boxes that a shader walks without a stack
// (shaders/shadow_hierarchy.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shadow/edges.h"

namespace steradian::vulkan {

// Vectors as shaders/shadow_layout.glsl has them.
std::vector<std::array<std::uint32_t, 4>> ray_hierarchy(const shadow::EdgeMesh& mesh);

// How many it has at least: what is too many for a buffer need not be sorted.
std::size_t least_of_hierarchy(const shadow::EdgeMesh& mesh);

}  // namespace steradian::vulkan
