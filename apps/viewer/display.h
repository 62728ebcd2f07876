// A picture in screen form: 8 bits per channel, rows from the top.
#pragma once

#include <cstdint>
#include <vector>

#include "steradian/tone.h"

namespace steradian::view {

struct Display {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

// Equals a PNG written with this exposure and curve, bit for bit.
Display shown(const Picture& picture, float exposure_stops, ToneCurve curve);

// |a - b|, the largest of three channels, over the mean luminance of b. The colours run from black at 0 through red and yellow to white at
// `most`.
Display error_map(const Picture& a, const Picture& b, double most);
// The colour of a fraction of `most`, 0 to 1.
Vec3f heat(double share);

// Shows `a` left of the column and `b` from the column on. Both have one size.
Display split(const Display& a, const Display& b, int column);

}  // namespace steradian::view
