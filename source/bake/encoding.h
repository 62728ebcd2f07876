// RGBM: colours of any brightness in the four bytes of a PNG.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "steradian/vector.h"

namespace steradian::bake {

// A colour is rgb times a times the range; all three are fractions of 255. The range is the largest channel of the map.
float rgbm_range(const std::vector<Vec3f>& colors);
std::array<std::uint8_t, 4> rgbm_of(Vec3f color, float range);
Vec3f color_of_rgbm(const std::uint8_t* rgbm, float range);

}  // namespace steradian::bake
