// Encodings of light maps against their steps.
#include "bake/encoding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/budget.h"
#include "core/random.h"
#include "image/codecs.h"

namespace steradian::bake_encoding_test {

// Half a step of sixteen bits, and the rounding of three products in single precision. Values beyond the range are cut off.
TEST(MapEncoding, SixteenBitsKeepHalfAStep) {
  reference::Random random(4);
  constexpr float kRange = 37.5f;
  for (int i = 0; i < 10000; ++i) {
    const Vec3f color{kRange * static_cast<float>(random.uniform()), kRange * static_cast<float>(random.uniform()), 0};
    const auto bytes = bake::rgb16_of(color, kRange);
    const Vec3f d = bake::color_of_rgb16(bytes.data(), kRange) - color;
    EXPECT_LE(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}), kRange * (0.5f / 65535 + 4e-7f));
  }
  const auto beyond = bake::rgb16_of({2 * kRange, -1, 0}, kRange);
  EXPECT_EQ(beyond, (std::array<std::uint8_t, 6>{255, 255, 0, 0, 0, 0}));
}

TEST(MapEncoding, PngHoldsSixteenBits) {
  const std::string png = image::encode_png_rgb16(3, 2, [](int y, std::uint8_t* row) {
    for (int i = 0; i < 18; ++i) row[i] = static_cast<std::uint8_t>(20 * y + i + (i % 2 == 1 ? 100 : 0));
  });
  EXPECT_EQ(png[24], 16);  // bits a channel
  EXPECT_EQ(png[25], 2);   // red, green and blue
  Budget budget;
  const Image image = image::decode_png({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()}, "png", 100, budget);
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  for (int i = 0; i < 6; ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image.rgba[static_cast<std::size_t>(4 * i + c)], 20 * (i / 3) + 6 * (i % 3) + 2 * c, 1)
          << "the high byte is the larger part";
}

}  // namespace steradian::bake_encoding_test
