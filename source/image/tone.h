// The two halves of tone_map, for callers that map whole pictures repeatedly.
#pragma once

#include <cstddef>
#include <cstdint>

#include "steradian/tone.h"

namespace steradian::image {

// The value that tone_map encodes: exposed by the factor `scale` and compressed, linear in [0, 1].
Vec3f tone_curve(Vec3f radiance, float scale, ToneCurve curve = ToneCurve::neutral);

// The 8-bit code of a linear value in [0, 1]: srgb_encode times 255, rounded to the nearest, by a table.
std::uint8_t srgb_byte(float linear);

// Applies both to a row of pixels and writes red, green, blue and 255. The bytes are the same; the neutral curve is several times faster.
void tone_row(const Vec3f* pixels, std::size_t count, float scale, std::uint8_t* rgba, ToneCurve curve = ToneCurve::neutral);

}  // namespace steradian::image
