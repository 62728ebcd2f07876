// PNG in memory, with text chunks; PNG and JPEG in.
#pragma once

#include <string>

#include "steradian/picture.h"

namespace steradian {

// 8 bits a channel of tone_map(pixel); metadata as tEXt chunks.
std::string encode_png(const Picture& picture, float exposure_stops);

Picture decode_ldr(const std::string& path);

}  // namespace steradian
