// JPEG reader: libjpeg-turbo, restricted to the features of a picture.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/texture.h"

namespace steradian::image {

// Throws Error(place, ...) for bytes that are not a whole picture, and for more than max_texels, before any memory is allocated.
Image decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget);

}  // namespace steradian::image
