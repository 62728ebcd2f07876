// The two halves of tone_map, for those who map whole pictures again and again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "steradian/tone.h"

namespace steradian::image {

// What tone_map encodes: exposed by the factor `scale` and compressed, linear in [0, 1].
Vec3f tone_curve(Vec3f radiance, float scale, ToneCurve curve = ToneCurve::neutral);

// The 8-bit code of a linear value in [0, 1]: srgb_encode times 255, to the nearest, by a table.
std::uint8_t srgb_byte(float linear);

// Both of pixels side by side, to red, green, blue and 255: the same bytes, several times faster by the neutral curve.
void tone_row(const Vec3f* pixels, std::size_t count, float scale, std::uint8_t* rgba, ToneCurve curve = ToneCurve::neutral);

}  // namespace steradian::image
