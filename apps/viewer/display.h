// A picture as a screen shows it: 8 bits a channel, rows from the top.
#pragma once

#include <cstdint>
#include <vector>

#include "steradian/tone.h"

namespace steradian::view {

struct Display {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

// As a PNG of the exposure and the curve is written, bit for bit.
Display shown(const Picture& picture, float exposure_stops, ToneCurve curve);

// |a - b|, the largest of three channels, over the mean luminance of b: black at 0, through red and yellow to white at `most`.
Display error_map(const Picture& a, const Picture& b, double most);
// The colour of a share of `most`, 0 to 1.
Vec3f heat(double share);

// Left of the column `a`, from it on `b`: of one size.
Display split(const Display& a, const Display& b, int column);

}  // namespace steradian::view
