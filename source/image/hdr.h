// Radiance pictures (.hdr): RGBE, four bytes a pixel.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/picture.h"

namespace steradian::image {

// Reads rows from the top and columns from the left, flat or in the run lengths of today's files. A file's EXPOSURE lines are divided out:
// the result is radiance. Throws Error(place, ...) for bytes that are not a whole picture. Memory is allocated after the header has been
// checked against the bytes that follow.
// Source: Ward, "Real pixels", Graphics Gems II, 1991; the Radiance file formats, "Picture file format".
Picture decode_hdr(std::span<const std::uint8_t> bytes, const std::string& place, Budget& budget);

}  // namespace steradian::image
