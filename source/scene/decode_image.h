// Decodes PNG and JPEG bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "steradian/texture.h"

namespace steradian {

enum class ImageFormat { png_or_jpeg, known_but_not_read, unknown };
ImageFormat format_of(std::span<const std::uint8_t> bytes);

// Throws Error(place, ...) for bytes that are no whole picture and for one of more than max_texels.
Image decode_image(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels);

}  // namespace steradian
