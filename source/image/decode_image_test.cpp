// Whole pictures of every kind, and damaged ones: these are refused with a message, without reads beyond their end.
#include "image/codecs.h"

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>
#include <jpeglib.h>
#include <png.h>
#include <random>

#include "steradian/picture.h"

namespace steradian::decode_image_test {
namespace {

using namespace image;

constexpr std::size_t kMost = 1 << 24;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

Image decoded(const std::string& file) {
  Budget budget;
  return decode_image(bytes_of(file), "picture", kMost, budget);
}

std::string refusal(const std::string& file, std::size_t most = kMost, const Limits& limits = {}) {
  Budget budget(limits);
  try {
    decode_image(bytes_of(file), "picture", most, budget);
  } catch (const Error& e) {
    EXPECT_EQ(e.place(), "picture");
    return e.what();
  }
  return "";
}

enum class Scans { one, progressive };

// A smooth picture: red grows to the right, green downwards.
std::string jpeg(unsigned width, unsigned height, Scans scans, int components = 3) {
  jpeg_compress_struct codec;
  jpeg_error_mgr errors;
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* out = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &out, &size);
  codec.image_width = width;
  codec.image_height = height;
  codec.input_components = components;
  codec.in_color_space = components == 3 ? JCS_RGB : components == 1 ? JCS_GRAYSCALE : JCS_CMYK;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, 95, TRUE);
  if (scans == Scans::progressive) jpeg_simple_progression(&codec);
  jpeg_start_compress(&codec, TRUE);
  std::vector<unsigned char> row(width * static_cast<unsigned>(components));
  for (unsigned y = 0; y < height; ++y) {
    for (unsigned x = 0; x < width; ++x)
      for (unsigned c = 0; c < static_cast<unsigned>(components); ++c)
        row[x * static_cast<unsigned>(components) + c] = static_cast<unsigned char>(c == 0   ? 255 * x / width
                                                                                    : c == 1 ? 255 * y / height
                                                                                             : 64);
    JSAMPROW rows[] = {row.data()};
    jpeg_write_scanlines(&codec, rows, 1);
  }
  jpeg_finish_compress(&codec);
  std::string file(reinterpret_cast<char*>(out), size);
  jpeg_destroy_compress(&codec);
  std::free(out);
  return file;
}

std::string png(int width, int height) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.at(x, y) = {static_cast<float>(x) / 40.0f, static_cast<float>(y) / 40.0f, 0.1f};
  picture.metadata["note"] = "text that no pixel needs";
  return encode_png(picture, 0);
}

// Encodes any kind of PNG with libpng itself.
std::string png_of(int color, int depth, int interlace, const std::vector<std::uint8_t>& pixels, unsigned width, unsigned height) {
  png_structp out = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(out);
  std::string file;
  png_set_write_fn(
      out, &file,
      [](png_structp p, png_bytep data, std::size_t n) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), n);
      },
      nullptr);
  png_set_IHDR(out, info, width, height, depth, color, interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (color == PNG_COLOR_TYPE_PALETTE) {
    const png_color palette[] = {{10, 20, 30}, {40, 50, 60}};
    const png_byte alpha[] = {255, 7};
    png_set_PLTE(out, info, palette, 2);
    png_set_tRNS(out, info, alpha, 2, nullptr);
  }
  png_set_gAMA(out, info, 1.0);  // must change nothing
  png_write_info(out, info);
  const std::size_t stride = png_get_rowbytes(out, info);
  std::vector<png_bytep> rows;
  for (unsigned y = 0; y < height; ++y) rows.push_back(const_cast<png_bytep>(pixels.data()) + y * stride);
  png_write_image(out, rows.data());
  png_write_end(out, nullptr);
  png_destroy_write_struct(&out, &info);
  return file;
}

std::vector<int> texel(const Image& image, std::size_t i) {
  return {image.rgba[4 * i], image.rgba[4 * i + 1], image.rgba[4 * i + 2], image.rgba[4 * i + 3]};
}

}  // namespace

TEST(DecodeImage, ReadsJpegsOfOneScanAndOfMany) {
  for (const Scans scans : {Scans::one, Scans::progressive}) {
    const Image image = decoded(jpeg(37, 23, scans));
    ASSERT_EQ(image.width, 37);
    ASSERT_EQ(image.height, 23);
    for (std::size_t y = 0; y < 23; ++y)
      for (std::size_t x = 0; x < 37; ++x) {
        const std::vector<int> t = texel(image, y * 37 + x);
        // Quality 95 with halved chroma: the ramp's steps are 7 and 11.
        EXPECT_NEAR(t[0], 255 * static_cast<int>(x) / 37, 12) << x << ' ' << y;
        EXPECT_NEAR(t[1], 255 * static_cast<int>(y) / 23, 12);
        EXPECT_EQ(t[3], 255);
      }
  }
  EXPECT_EQ(texel(decoded(jpeg(8, 8, Scans::one, 1)), 0), (std::vector<int>{0, 0, 0, 255}));
}

TEST(DecodeImage, ReadsEveryKindOfPng) {
  EXPECT_EQ(texel(decoded(png_of(PNG_COLOR_TYPE_GRAY, 1, PNG_INTERLACE_NONE, {0x40}, 2, 1)), 1), (std::vector<int>{255, 255, 255, 255}));
  EXPECT_EQ(texel(decoded(png_of(PNG_COLOR_TYPE_PALETTE, 1, PNG_INTERLACE_NONE, {0x40}, 2, 1)), 1), (std::vector<int>{40, 50, 60, 7}));
  EXPECT_EQ(texel(decoded(png_of(PNG_COLOR_TYPE_GRAY_ALPHA, 8, PNG_INTERLACE_NONE, {9, 8}, 1, 1)), 0), (std::vector<int>{9, 9, 9, 8}));
  EXPECT_EQ(texel(decoded(png_of(PNG_COLOR_TYPE_RGB, 16, PNG_INTERLACE_NONE, {10, 10, 20, 20, 255, 255}, 1, 1)), 0),
            (std::vector<int>{10, 20, 255, 255}));
  std::vector<std::uint8_t> rgba(4 * 9 * 11);
  for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(i);
  EXPECT_EQ(decoded(png_of(PNG_COLOR_TYPE_RGB_ALPHA, 8, PNG_INTERLACE_ADAM7, rgba, 9, 11)).rgba, rgba);
}

TEST(DecodeImage, RefusesEveryBeginningOfAPicture) {
  for (const std::string& whole : {jpeg(40, 30, Scans::one), jpeg(40, 30, Scans::progressive), png(20, 10)}) {
    ASSERT_EQ(refusal(whole), "");
    for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_NE(refusal(whole.substr(0, n)), "") << n << " of " << whole.size();
  }
}

// Random changes of bytes give a picture of the header's size, or a refusal; the sanitizers detect reads out of bounds.
TEST(DecodeImage, SurvivesDamage) {
  std::mt19937 random(7);
  for (const std::string& whole : {jpeg(40, 30, Scans::one), jpeg(40, 30, Scans::progressive), jpeg(17, 5, Scans::one, 4), png(20, 10)})
    for (int i = 0; i < 3000; ++i) {
      std::string file = whole;
      for (int k = static_cast<int>(random() % 4); k >= 0; --k) file[random() % file.size()] = static_cast<char>(random());
      Budget budget({.memory = 50'000'000});
      try {
        const Image image = decode_image(bytes_of(file), "picture", kMost, budget);
        ASSERT_EQ(image.rgba.size(), std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
      } catch (const Error& e) {
        ASSERT_EQ(e.place(), "picture");
      }
    }
}

// Each Huffman table of the file in turn is filled with the same byte, for every value.
TEST(DecodeImage, SurvivesBrokenHuffmanTables) {
  const std::string whole = jpeg(40, 30, Scans::one);
  std::size_t tables = 0;
  for (std::size_t at = whole.find("\xFF\xC4"); at != std::string::npos; at = whole.find("\xFF\xC4", at + 2)) {
    ++tables;
    const std::size_t length = static_cast<std::uint8_t>(whole[at + 2]) * 256u + static_cast<std::uint8_t>(whole[at + 3]);
    for (int value = 0; value < 256; ++value) {
      std::string codes = whole, symbols = whole;
      for (std::size_t i = at + 5; i < at + 21; ++i) codes[i] = static_cast<char>(value);
      for (std::size_t i = at + 21; i < at + 2 + length; ++i) symbols[i] = static_cast<char>(value);
      refusal(codes);
      refusal(symbols);
    }
  }
  EXPECT_GE(tables, 2u);
}

TEST(DecodeImage, RefusesASizeBeforeItTakesMemory) {
  std::string huge = jpeg(40, 30, Scans::one);
  const std::size_t frame = huge.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  for (std::size_t i = 5; i < 9; ++i) huge[frame + i] = '\xFF';
  EXPECT_NE(refusal(huge), "") << "65535 x 65535 is more than the format's library takes";
  for (std::size_t i = 5; i < 9; i += 2) huge.replace(frame + i, 2, "\xFF\xDC");
  EXPECT_NE(refusal(huge).find("claims 65500 x 65500 texels, more than may be read (16777216)"), std::string::npos) << refusal(huge);
  // The size is allowed, but the memory is refused: the progressive form stores all coefficients.
  EXPECT_NE(refusal(huge, std::size_t{1} << 40).find("would take 17.2 GB of memory for the picture's texels"), std::string::npos)
      << refusal(huge, std::size_t{1} << 40);
  const std::string progressive = jpeg(600, 400, Scans::progressive);
  EXPECT_EQ(refusal(progressive, kMost, {.memory = 60'000'000}), "");
  EXPECT_NE(refusal(progressive, kMost, {.memory = 2'000'000}), "");

  std::string wide = png(20, 10);
  for (std::size_t i = 16; i < 24; ++i) wide[i] = i % 4 == 0 ? '\x7F' : '\xFF';
  EXPECT_NE(refusal(wide), "") << "its checksum is wrong";
  const std::string big = png_of(PNG_COLOR_TYPE_GRAY, 1, PNG_INTERLACE_NONE, std::vector<std::uint8_t>(8192 * 1024), 65536, 1024);
  EXPECT_LT(big.size(), 20000u);
  EXPECT_NE(refusal(big).find("claims 65536 x 1024 texels"), std::string::npos) << refusal(big);
}

// Thousands of empty scans, each of which costs a pass over the picture.
TEST(DecodeImage, RefusesAJpegOfTooManyScans) {
  std::string file = jpeg(40, 30, Scans::progressive);
  const std::size_t last = file.rfind("\xFF\xDA"), end = file.rfind("\xFF\xD9");
  const std::string scan = file.substr(last, end - last);
  for (int i = 0; i < 300; ++i) file.insert(end, scan);
  EXPECT_NE(refusal(file), "");
}

TEST(DecodeImage, OpensNoOtherFormat) {
  // First bytes of Softimage, Radiance, GIF, BMP, TGA, PNM and PSD.
  for (const std::string& other : {std::string("\x53\x80\xF6\x34") + std::string(100, '\0'),
                                   std::string("#?RADIANCE\n\n-Y 1 +X 1\n\1\1\1\1"), std::string("GIF89a") + std::string(64, '\1'),
                                   std::string("BM") + std::string(64, '\1'), std::string(2, '\0') + "\2" + std::string(64, '\1'),
                                   std::string("P6 1 1 255 \1\1\1"), std::string("8BPS") + std::string(64, '\1'), std::string()}) {
    EXPECT_EQ(format_of(bytes_of(other)), ImageFormat::unknown);
    EXPECT_NE(refusal(other).find("neither PNG nor JPEG"), std::string::npos);
  }
}

// An EXR's header is checked before memory for its blocks is allocated.
TEST(DecodeExr, SurvivesDamageAndRefusesSizes) {
  Picture picture(9, 7);
  picture.layers["variance"].resize(63);
  picture.metadata["note"] = "text";
  const std::string whole = encode_exr(picture);
  const auto read = [](const std::string& file, std::uint64_t memory) -> std::string {
    Budget budget({.memory = memory});
    try {
      decode_exr(bytes_of(file), "picture", budget);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(read(whole, 50'000'000), "");
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_NE(read(whole.substr(0, n), 50'000'000), "") << n;
  std::mt19937 random(11);
  for (int i = 0; i < 5000; ++i) {
    std::string file = whole;
    for (int k = static_cast<int>(random() % 3); k >= 0; --k) file[random() % file.size()] = static_cast<char>(random());
    read(file, 50'000'000);
  }
  std::string claims = whole;
  claims.replace(claims.find("channels") + 9 + 7, 4, "\xFF\xFF\xFF\x7F");
  EXPECT_NE(read(claims, 1'000'000'000).find("header is cut off or damaged"), std::string::npos) << read(claims, 1'000'000'000);
  std::string huge = whole;
  const std::size_t window = huge.find("dataWindow") + 11 + 6 + 4 + 8;  // name, type "box2i", size, and its lower corner
  for (std::size_t i = 0; i < 8; i += 4) huge.replace(window + i, 4, std::string("\xFF\x7F\0\0", 4));
  EXPECT_NE(read(huge, 1'000'000'000).find("of memory for the picture's pixels"), std::string::npos) << read(huge, 1'000'000'000);
}

// A list of texts claims 1.9 GB inside an attribute of four bytes, and OpenEXR would allocate them. Nobody asked for the list.
TEST(DecodeExr, LooksIntoNoAttributeThatAPictureDoesNotNeed) {
  const std::string whole = encode_exr(Picture(9, 7)), attribute = std::string("odd\0stringvector\0\4\0\0\0", 21) + "\xFF\xFF\xFF\x6F";
  // The last attribute: name, type "float", size, value, and the zero that ends the header. Then the position of the one block of lines.
  const std::size_t place = whole.find("screenWindowWidth") + 18 + 6 + 4 + 4 + 1;
  std::string file = whole;
  const std::size_t moved = static_cast<unsigned char>(file[place]) + 256u * static_cast<unsigned char>(file[place + 1]) + attribute.size();
  file[place] = static_cast<char>(moved & 255);
  file[place + 1] = static_cast<char>(moved >> 8);
  file.insert(8, attribute);
  Budget budget({.memory = 50'000'000});
  EXPECT_EQ(decode_exr(bytes_of(file), "picture", budget).width, 9);
}

}  // namespace steradian::decode_image_test
