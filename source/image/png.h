// PNG reader and writer: libpng, restricted to what a picture needs.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/texture.h"
#include "steradian/tone.h"

namespace steradian::image {

// Encodes 8 bits a channel of tone_map(pixel); metadata becomes tEXt chunks.
std::string encode_png(const Picture& picture, float exposure_stops, ToneCurve curve = ToneCurve::neutral);

// Fills the bytes of row y, three a pixel. Must not throw.
using RowOfBytes = std::function<void(int y, std::uint8_t* row)>;
std::string encode_png_bytes(int width, int height, const RowOfBytes& fill);

// Reads every kind of PNG as RGBA, 8 bits a channel. The file's statements about colour spaces are ignored, as glTF asks. Throws
// Error(place, ...) for bytes that are not a whole picture, and for more than max_texels, before any memory is allocated.
Image decode_png(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget);

}  // namespace steradian::image
