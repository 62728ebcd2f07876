// Detection of a picture's format by its first bytes, and the pixels of PNG and JPEG.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/budget.h"
#include "steradian/texture.h"

namespace steradian::image {

enum class ImageFormat { png, jpeg, known_but_not_read, unknown };
ImageFormat format_of(std::span<const std::uint8_t> bytes);

// Throws Error(place, ...) for bytes that are not a whole PNG or JPEG. Also throws for a picture of more than max_texels, before any memory
// is allocated for it.
Image decode_image(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget);

// Returns width times height; throws Error for an empty picture and for one of more than max_texels.
std::size_t checked_texels(std::size_t width, std::size_t height, const std::string& place, std::size_t max_texels);

}  // namespace steradian::image
