#include "image/png.h"

#include <zlib.h>

#include <cmath>
#include <cstdint>

#include "image/stb.h"
#include "steradian/error.h"

namespace steradian {
namespace {

std::string big_endian(std::uint32_t x) {
  std::string s(4, '\0');
  for (int i = 0; i < 4; ++i) s[static_cast<std::size_t>(i)] = static_cast<char>((x >> (24 - 8 * i)) & 0xff);
  return s;
}

// A chunk: length, type, data, CRC of type and data (PNG specification, section 5.3).
std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(crc);
}

constexpr std::size_t kEndOfHeader = 8 + 25;  // signature and IHDR, after which text may stand

}  // namespace

std::string encode_png(const Picture& picture, float exposure_stops) {
  std::vector<unsigned char> bytes;
  bytes.reserve(picture.pixels.size() * 3);
  for (const Vec3f& p : picture.pixels) {
    const Vec3f c = tone_map(p, exposure_stops);
    for (float x : {c.x, c.y, c.z}) bytes.push_back(static_cast<unsigned char>(std::lround(x * 255.0f)));
  }
  std::string file;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &file, picture.width, picture.height, 3, bytes.data(), picture.width * 3))
    throw Error("", "the PNG encoder ran out of memory");
  std::string text;
  for (const auto& [key, value] : picture.metadata) text += chunk("tEXt", key + std::string(1, '\0') + value);
  return file.insert(kEndOfHeader, text);
}

Picture decode_ldr(const std::string& path) {
  int width = 0, height = 0, channels = 0;
  unsigned char* data = stbi_load(path.c_str(), &width, &height, &channels, 3);
  if (data == nullptr) throw Error(path, std::string("not a readable picture: ") + stbi_failure_reason());
  Picture picture(width, height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const auto linear = [&](std::size_t c) { return srgb_decode(static_cast<float>(data[3 * i + c]) / 255.0f); };
    picture.pixels[i] = {linear(0), linear(1), linear(2)};
  }
  stbi_image_free(data);
  return picture;
}

}  // namespace steradian
