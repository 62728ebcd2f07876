// The shaders of the plane, compiled at build time and part of the program.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace steradian::plane {

// By LightGroup; then the shader of round lights by the device's lists, and the one that computes these lists.
std::vector<std::span<const std::uint32_t>> plane_shaders();

}  // namespace steradian::plane
