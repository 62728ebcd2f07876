#include "image/decode_image.h"

#include <cstring>

#include "image/jpeg.h"
#include "image/png.h"

namespace steradian::image {

ImageFormat format_of(std::span<const std::uint8_t> bytes) {
  const auto begins = [&](const char* magic, std::size_t n) { return bytes.size() >= n && std::memcmp(bytes.data(), magic, n) == 0; };
  if (begins("\x89PNG\r\n\x1A\n", 8)) return ImageFormat::png;
  if (begins("\xFF\xD8\xFF", 3)) return ImageFormat::jpeg;
  if (begins("\xABKTX", 4) || begins("RIFF", 4) || begins("DDS ", 4)) return ImageFormat::known_but_not_read;
  return ImageFormat::unknown;
}

std::size_t checked_texels(std::size_t width, std::size_t height, const std::string& place, std::size_t max_texels) {
  if (width < 1 || height < 1) throw Error(place, "the picture has no pixels");
  // Both are below 2^31: the product is exact.
  if (width * height > max_texels)
    throw Error(place,
                "the picture claims " + std::to_string(width) + " x " + std::to_string(height) + " texels, more than may be read (" +
                    std::to_string(max_texels) + ")",
                "use a smaller picture");
  return width * height;
}

Image decode_image(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget) {
  switch (format_of(bytes)) {
    case ImageFormat::png: return decode_png(bytes, place, max_texels, budget);
    case ImageFormat::jpeg: return decode_jpeg(bytes, place, max_texels, budget);
    default: throw Error(place, "the picture is neither PNG nor JPEG", "save it as PNG");
  }
}

}  // namespace steradian::image
