// Encodings of colours of any brightness in a PNG.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "steradian/vector.h"

namespace steradian::bake {

// rgbm: a colour is rgb times a times the range, as fractions of 255. rgb16: it is rgb times the range, as a fraction of 65535.
enum class MapEncoding { rgbm, rgb16 };

// rgbm for any other word.
MapEncoding encoding_of(const std::string& word);

// The range of both: the largest channel of the map.
float range_of(const std::vector<Vec3f>& colors);
std::array<std::uint8_t, 4> rgbm_of(Vec3f color, float range);
Vec3f color_of_rgbm(const std::uint8_t* rgbm, float range);

// The high byte of each channel comes first.
std::array<std::uint8_t, 6> rgb16_of(Vec3f color, float range);
Vec3f color_of_rgb16(const std::uint8_t* rgb16, float range);

}  // namespace steradian::bake
