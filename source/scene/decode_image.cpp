#include "scene/decode_image.h"

#include <climits>
#include <cstring>
#include <memory>

#include "steradian/error.h"

// Static: another part of the program may bring its own copy. Only the formats that glTF knows.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace steradian {

ImageFormat format_of(std::span<const std::uint8_t> bytes) {
  const auto begins = [&](const char* magic, std::size_t n) {
    return bytes.size() >= n && std::memcmp(bytes.data(), magic, n) == 0;
  };
  if (begins("\x89PNG", 4) || begins("\xFF\xD8\xFF", 3)) return ImageFormat::png_or_jpeg;
  if (begins("\xABKTX", 4) || begins("RIFF", 4) || begins("DDS ", 4)) return ImageFormat::known_but_not_read;
  return ImageFormat::unknown;
}

Image decode_image(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels) {
  const char* hint = "textures must be PNG or JPEG; save the picture again";
  if (bytes.size() > INT_MAX) throw Error(place, "the picture has more than 2 GiB", hint);
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) || width < 1 || height < 1)
    throw Error(place, std::string("cannot read the picture: ") + stbi_failure_reason(), hint);
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (texels > max_texels)
    throw Error(place,
                "the picture claims " + std::to_string(width) + " x " + std::to_string(height) +
                    " texels, more than may be read (" + std::to_string(max_texels) + ")",
                "use smaller textures");
  const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
  if (!decoded) throw Error(place, std::string("cannot read the picture: ") + stbi_failure_reason(), hint);
  Image image;
  image.width = width;
  image.height = height;
  image.rgba.assign(decoded.get(), decoded.get() + 4 * texels);
  return image;
}

}  // namespace steradian
