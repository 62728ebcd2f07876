// Which picture format some bytes are in, by their first bytes, and the pixels of those that are read: PNG and JPEG.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/texture.h"

namespace steradian::image {

enum class ImageFormat { png, jpeg, known_but_not_read, unknown };
ImageFormat format_of(std::span<const std::uint8_t> bytes);

// Throws Error(place, ...) for bytes that are no whole PNG or JPEG and for a picture of more than max_texels, before any
// memory is taken for it.
Image decode_image(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget);

// width times height; throws Error for none and for more than may be read.
std::size_t checked_texels(std::size_t width, std::size_t height, const std::string& place, std::size_t max_texels);

}  // namespace steradian::image
