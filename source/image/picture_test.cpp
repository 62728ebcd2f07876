#include "steradian/picture.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

#include "image/codecs.h"
#include "steradian/error.h"

namespace steradian::picture_test {
namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("steradian_picture_test_" + std::to_string(getpid()) + name)).string();
}

Picture test_picture() {
  Picture picture(7, 5);
  picture.layers["variance"].resize(35);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x) {
      const float v = static_cast<float>(x) + 10.0f * static_cast<float>(y);
      picture.at(x, y) = {v, v * 0.25f, 1e5f + v};
      picture.layers["variance"][static_cast<std::size_t>(y * 7 + x)] = {1e-9f * v, -v, 0.5f};
    }
  picture.metadata["steradian.method"] = "exact";
  return picture;
}

}  // namespace

TEST(Picture, ExrKeepsEveryBitLayersAndMetadata) {
  const std::string path = temporary(".exr");
  const Picture a = test_picture();
  write_picture(a, path);
  const Picture b = read_picture(path);
  ASSERT_EQ(b.width, 7);
  ASSERT_EQ(b.height, 5);
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.layers, b.layers);
  EXPECT_EQ(b.metadata.at("steradian.method"), "exact");
  std::filesystem::remove(path);
}

TEST(Picture, ExrHasTheSameBytesWithAnyThreads) {
  Picture picture(300, 200);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = {std::sin(0.1f * static_cast<float>(i)), 1, 2};
  const std::string one = image::encode_exr(picture);
  for (const int threads : {2, 3, 1}) {
    image::encode_exr_with(threads);
    EXPECT_EQ(image::encode_exr(picture), one) << threads;
  }
}

TEST(Picture, ExrKeepsAlpha) {
  const std::string path = temporary("_alpha.exr");
  Picture a = test_picture();
  for (int i = 0; i < 35; ++i) {
    const float alpha = static_cast<float>(i) / 34;
    a.layers["alpha"].push_back({alpha, alpha, alpha});
  }
  write_picture(a, path);
  const Picture b = read_picture(path);
  EXPECT_EQ(a.layers, b.layers);
  EXPECT_TRUE(b.unread.empty());
  std::filesystem::remove(path);
}

TEST(Picture, PngIsToneMappedAndCarriesText) {
  const std::string path = temporary(".png");
  Picture a(2, 1);
  a.at(0, 0) = {0.18f, 0.18f, 0.18f};
  a.metadata["steradian.method"] = "exact";
  write_picture(a, path);
  const Picture b = read_picture(path);
  // Neutral grey passes through the curve minus its 0.04 offset; 8 bits of sRGB resolve 0.004 here.
  EXPECT_NEAR(b.at(0, 0).x, 0.14f, 0.004f);
  EXPECT_EQ(b.at(1, 0).y, 0.0f);
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(bytes.find(std::string("steradian.method\0exact", 22)), std::string::npos);
  std::filesystem::remove(path);
}

TEST(Picture, SrgbFunctionsAreInverse) {
  for (int i = 0; i <= 255; ++i) {
    const float e = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(srgb_encode(srgb_decode(e)), e, 1e-6f);
  }
}

TEST(Picture, ToneCurveRisesAndStaysInRange) {
  float last = -1;
  for (int i = 0; i < 400; ++i) {
    const float x = static_cast<float>(i) * 0.05f;
    const float y = tone_map({x, x, x}, 0.0f).x;
    EXPECT_GE(y, last);
    EXPECT_LE(y, 1.0f);
    last = y;
  }
}

TEST(Picture, BadFilesAreRefusedWithTheirName) {
  EXPECT_THROW(write_picture(test_picture(), temporary(".bmp")), Error);
  EXPECT_THROW(write_picture(test_picture(), "/nonexistent/folder/a.exr"), Error);
  EXPECT_THROW(read_picture("/nonexistent.exr"), Error);
  const std::string path = temporary("_bad.exr");
  std::ofstream(path) << "not a picture";
  EXPECT_THROW(read_picture(path), Error);
  std::filesystem::remove(path);
}

// The bytes must be of the format that the name's ending says.
TEST(Picture, IsOpenedByItsEndingAndNothingElse) {
  const std::string png = temporary(".png"), named_jpeg = temporary(".jpg"), softimage = temporary("_softimage.png");
  write_picture(test_picture(), png);
  std::filesystem::copy_file(png, named_jpeg);
  std::ofstream(softimage, std::ios::binary) << "\x53\x80\xF6\x34" << std::string(200, '\x01');
  EXPECT_EQ(read_picture(png).width, 7);
  for (const std::string& path : {named_jpeg, softimage}) {
    try {
      read_picture(path);
      ADD_FAILURE() << path;
    } catch (const Error& e) {
      EXPECT_EQ(e.place(), path);
      EXPECT_NE(e.problem().find("another format's"), std::string::npos) << e.what();
    }
  }
  for (const std::string& path : {png, named_jpeg, softimage}) std::filesystem::remove(path);
}

TEST(Picture, IsRefusedWhereItExceedsTheMemory) {
  const std::string path = temporary("_large.exr");
  write_picture(Picture(300, 300), path);
  EXPECT_THROW(read_picture(path, Limits{.memory = 1'000'000}), Error);
  EXPECT_EQ(read_picture(path).width, 300);
  std::filesystem::remove(path);
}

}  // namespace steradian::picture_test
