// Selection of the file format by the name's ending.
#include "steradian/picture.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "core/files.h"
#include "image/codecs.h"
#include "image/picture_name.h"
#include "steradian/error.h"

namespace steradian {
namespace {

std::string ending(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string e = dot == std::string::npos ? "" : path.substr(dot);
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

// Pixels of the largest picture that render creates, 16384 x 16384.
constexpr std::size_t kMostPixels = std::size_t{1} << 28;

Picture linear_picture(const Image& image, const std::string& place, Budget& budget) {
  const std::size_t pixels = image.rgba.size() / 4;
  budget.take_memory(place, "the picture's linear pixels", sizeof(Vec3f) * pixels);
  Picture picture(image.width, image.height);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* p = image.rgba.data() + 4 * i;
    picture.pixels[i] = {linear_from_srgb8(p[0]), linear_from_srgb8(p[1]), linear_from_srgb8(p[2])};
  }
  return picture;
}

}  // namespace

void image::check_picture_name(const std::string& path) {
  const std::string e = ending(path);
  if (e != ".exr" && e != ".png") throw Error(path, "unknown picture format '" + e + "'", "use .exr (linear) or .png (tone mapped)");
}

void write_picture(const Picture& picture, const std::string& path, float exposure_stops) {
  write_picture(picture, path, exposure_stops, ToneCurve::neutral);
}

void write_picture(const Picture& picture, const std::string& path, float exposure_stops, ToneCurve curve) {
  image::check_picture_name(path);
  write_file(path, ending(path) == ".exr" ? image::encode_exr(picture) : image::encode_png(picture, exposure_stops, curve));
}

Picture read_picture(const std::string& path, const Limits& limits) {
  const std::string e = ending(path);
  const bool png = e == ".png", jpeg = e == ".jpg" || e == ".jpeg";
  if (e != ".exr" && e != ".hdr" && !png && !jpeg) throw Error(path, "unknown picture format '" + e + "'", "use .exr, .hdr, .png or .jpg");
  Budget budget(limits);
  try {
    const Bytes bytes = read_file(path, path, budget);
    if (e == ".exr") return image::decode_exr(bytes, path, budget);
    if (e == ".hdr") return image::decode_hdr(bytes, path, budget);
    // The ending says which format was requested; the bytes must be in that format.
    if (image::format_of(bytes) != (png ? image::ImageFormat::png : image::ImageFormat::jpeg))
      throw Error(path, std::string("is not a ") + (png ? "PNG" : "JPEG") + " picture: its first bytes are another format's",
                  "name the file by its format, or save it again");
    return linear_picture(image::decode_image(bytes, path, kMostPixels, budget), path, budget);
  } catch (const std::bad_alloc&) {
    throw budget.out_of_memory();
  }
}

Picture read_picture(const std::string& path) { return read_picture(path, Limits{}); }

}  // namespace steradian

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
