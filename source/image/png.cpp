#include "image/codecs.h"

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <map>
#include <png.h>

#include "image/tone.h"

namespace steradian::image {
namespace {

// State that libpng refers to. libpng's errors jump out of its calls, so nothing here may need a destructor.
struct Codec {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::jmp_buf failed;
  char message[160] = "out of memory";
  const std::uint8_t* at = nullptr;  // reading: the rest of the file
  std::size_t left = 0;
  std::string* file = nullptr;  // writing
};

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  auto& codec = *static_cast<Codec*>(png_get_error_ptr(png));
  std::snprintf(codec.message, sizeof codec.message, "%s", message);
  std::longjmp(codec.failed, 1);
}

void ignore(png_structp, png_const_charp) {}

void take_bytes(png_structp png, png_bytep to, std::size_t n) {
  auto& codec = *static_cast<Codec*>(png_get_io_ptr(png));
  if (n > codec.left) fail(png, "the file is cut off");
  std::memcpy(to, codec.at, n);
  codec.at += n;
  codec.left -= n;
}

// An exception must not leave through libpng's frames.
void give_bytes(png_structp png, png_bytep from, std::size_t n) {
  auto& codec = *static_cast<Codec*>(png_get_io_ptr(png));
  bool done = true;
  try {
    codec.file->append(reinterpret_cast<const char*>(from), n);
  } catch (const std::exception&) {
    done = false;
  }
  if (!done) fail(png, "out of memory");
}

struct OpenPng {
  Codec codec;
  ~OpenPng() { png_destroy_read_struct(&codec.png, &codec.info, nullptr); }
};

struct OpenWriter {
  Codec codec;
  ~OpenWriter() { png_destroy_write_struct(&codec.png, &codec.info); }
};

bool read_header(Codec& codec, png_uint_32& width, png_uint_32& height) {
  codec.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &codec, fail, ignore);
  if (codec.png == nullptr) return false;
  if (setjmp(codec.failed)) return false;
  codec.info = png_create_info_struct(codec.png);
  if (codec.info == nullptr) return false;
  // Only what the pixels need is read: texts and profiles may be compressed bombs.
  png_set_keep_unknown_chunks(codec.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_user_limits(codec.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // the caller checks the size, with its own message
  png_set_read_fn(codec.png, &codec, take_bytes);
  png_read_info(codec.png, codec.info);
  width = png_get_image_width(codec.png, codec.info);
  height = png_get_image_height(codec.png, codec.info);
  return true;
}

// rgba has four bytes for each of the header's pixels.
bool read_pixels(Codec& codec, std::uint8_t* rgba, std::size_t width, std::size_t height) {
  if (setjmp(codec.failed)) return false;
  png_set_expand(codec.png);
  png_set_scale_16(codec.png);
  png_set_gray_to_rgb(codec.png);
  png_set_add_alpha(codec.png, 255, PNG_FILLER_AFTER);
  const int passes = png_set_interlace_handling(codec.png);
  png_read_update_info(codec.png, codec.info);
  if (png_get_rowbytes(codec.png, codec.info) != 4 * width) fail(codec.png, "an unknown pixel format");
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t y = 0; y < height; ++y) png_read_row(codec.png, rgba + 4 * width * y, nullptr);
  png_read_end(codec.png, nullptr);
  return true;
}

using Metadata = std::map<std::string, std::string>;

enum class Channels { rgb = 3, rgba = 4, rgb16 = 6 };  // bytes a pixel

bool write_rows(Codec& codec, int width, int height, Channels channels, const Metadata& metadata, const RowOfBytes& fill,
                std::uint8_t* row) {
  codec.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &codec, fail, ignore);
  if (codec.png == nullptr) return false;
  if (setjmp(codec.failed)) return false;
  codec.info = png_create_info_struct(codec.png);
  if (codec.info == nullptr) return false;
  png_set_write_fn(codec.png, &codec, give_bytes, nullptr);
  png_set_IHDR(codec.png, codec.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
               channels == Channels::rgb16 ? 16 : 8, channels == Channels::rgba ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  for (const auto& [key, value] : metadata) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(key.c_str());  // libpng copies it
    text.text = const_cast<char*>(value.c_str());
    text.text_length = value.size();
    png_set_text(codec.png, codec.info, &text, 1);
  }
  png_write_info(codec.png, codec.info);
  for (int y = 0; y < height; ++y) {
    fill(y, row);
    png_write_row(codec.png, row);
  }
  png_write_end(codec.png, nullptr);
  return true;
}

std::string encode(int width, int height, Channels channels, const Metadata& metadata, const RowOfBytes& fill) {
  std::string file;
  std::vector<std::uint8_t> row(static_cast<std::size_t>(channels) * static_cast<std::size_t>(width));
  OpenWriter open;
  open.codec.file = &file;
  if (!write_rows(open.codec, width, height, channels, metadata, fill, row.data()))
    throw Error("", "cannot make a PNG of " + std::to_string(width) + " x " + std::to_string(height) + " pixels: " + open.codec.message);
  return file;
}

}  // namespace

std::string encode_png(const Picture& picture, float exposure_stops, ToneCurve curve) {
  const auto layer = picture.layers.find("alpha");
  const Vec3f* alpha = layer == picture.layers.end() ? nullptr : layer->second.data();
  const Channels channels = alpha == nullptr ? Channels::rgb : Channels::rgba;
  const float scale = std::exp2(exposure_stops);
  return encode(picture.width, picture.height, channels, picture.metadata, [&](int y, std::uint8_t* byte) {
    for (int x = 0; x < picture.width; ++x) {
      // PNG's colours are not multiplied by their coverage.
      const float cover =
          alpha == nullptr ? 1.0f
                           : alpha[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)].x;
      const Vec3f c = tone_curve(picture.at(x, y) / std::max(cover, 1e-6f), scale, curve);
      for (const float channel : {c.x, c.y, c.z}) *byte++ = srgb_byte(channel);
      if (alpha != nullptr) *byte++ = static_cast<std::uint8_t>(std::lround(std::clamp(cover, 0.0f, 1.0f) * 255.0f));
    }
  });
}

std::string encode_png_bytes(int width, int height, const RowOfBytes& fill) { return encode(width, height, Channels::rgb, {}, fill); }

std::string encode_png_rgba(int width, int height, const RowOfBytes& fill) { return encode(width, height, Channels::rgba, {}, fill); }

std::string encode_png_rgb16(int width, int height, const RowOfBytes& fill) { return encode(width, height, Channels::rgb16, {}, fill); }

Image decode_png(std::span<const std::uint8_t> bytes, const std::string& place, std::size_t max_texels, Budget& budget) {
  OpenPng open;
  open.codec.at = bytes.data();
  open.codec.left = bytes.size();
  const auto refuse = [&] { throw Error(place, std::string("cannot read the PNG picture: ") + open.codec.message, "save it again"); };
  png_uint_32 width = 0, height = 0;
  if (!read_header(open.codec, width, height)) refuse();
  const std::size_t texels = checked_texels(width, height, place, max_texels);
  budget.take_memory(place, "the picture's texels", 4 * texels);
  Image image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.rgba.resize(4 * texels);
  if (!read_pixels(open.codec, image.rgba.data(), width, height)) refuse();
  return image;
}

}  // namespace steradian::image
