// The two halves of the tone curve: mapping whole pictures equals tone_map.
#include "image/tone.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "steradian/error.h"
#include "steradian/picture.h"

namespace steradian::image::tone_test {
namespace {

std::uint8_t byte_of(float encoded) { return static_cast<std::uint8_t>(std::lround(encoded * 255.0f)); }

// Every 97th float of [0, 1], and both sides of every value at which the code changes.
TEST(Tone, BytesByTableAreThoseOfTheTransferFunction) {
  const auto expected = [](float x) { return byte_of(std::clamp(srgb_encode(x), 0.0f, 1.0f)); };
  int wrong = 0;
  for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(1.0f); bits += 97) {
    const auto x = std::bit_cast<float>(bits);
    wrong += srgb_byte(x) != expected(x) ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0);
  for (int code = 1; code < 256; ++code) {
    std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);
    while (high - low > 1) (expected(std::bit_cast<float>((low + high) / 2)) < code ? low : high) = (low + high) / 2;
    EXPECT_EQ(srgb_byte(std::bit_cast<float>(low)), code - 1);
    EXPECT_EQ(srgb_byte(std::bit_cast<float>(high)), code);
  }
  for (const float outside : {-0.0f, -1.0f, 1.0f, 1.5f, 1e30f}) EXPECT_EQ(srgb_byte(outside), outside >= 1 ? 255 : 0) << outside;
}

// Labels of radiance 1 on `black` of 1000 pixels of black, beside dim surfaces.
Picture labelled(int black, int labels) {
  Picture picture(1000, 1);
  for (int i = 0; i < 1000; ++i) {
    const float value = i < black ? 0.0f : i < black + labels ? 1.0f : 0.004f;
    picture.pixels[static_cast<std::size_t>(i)] = {value, value, value};
  }
  return picture;
}

TEST(AutoExposure, LabelsOfABlackPictureStayBelowWhite) {
  // The labels are a tenth of 400 lit pixels. Their geometric mean, 0.004^0.9, would take 4.7 stops.
  EXPECT_NEAR(auto_exposure(labelled(600, 40)), 0, 1e-6f);
  // The mean decides where less than half is black, and where labels are less than a twentieth of the rest.
  for (const auto& [black, labels] : {std::pair{400, 60}, std::pair{600, 10}}) {
    const double lit = 1000 - black, mean = (lit - labels) / lit * std::log2(0.004);
    EXPECT_NEAR(auto_exposure(labelled(black, labels)), std::log2(0.18) - mean, 1e-5) << black;
  }
  EXPECT_EQ(auto_exposure(labelled(1000, 0)), 0);
  // The scale of the unit has no part in it.
  Picture bright = labelled(600, 40);
  for (Vec3f& c : bright.pixels) c = c * 1024.0f;
  EXPECT_NEAR(auto_exposure(bright), -10, 1e-5f);
}

TEST(Tone, HalvesMakeTheWhole) {
  std::mt19937 random(1);
  std::lognormal_distribution<float> radiance(0, 3);
  for (int i = 0; i < 100000; ++i) {
    const Vec3f c{radiance(random), radiance(random), i % 7 == 0 ? NAN : radiance(random)};
    const float stops = static_cast<float>(i % 9) - 4;
    const Vec3f whole = tone_map(c, stops), half = tone_curve(c, std::exp2(stops));
    ASSERT_EQ(srgb_byte(half.x), byte_of(whole.x));
    ASSERT_EQ(srgb_byte(half.y), byte_of(whole.y));
    ASSERT_EQ(srgb_byte(half.z), byte_of(whole.z));
  }
}

// Numbers computed by hand from the papers' formulas.
TEST(Tone, CurvesAreThoseOfTheirPapers) {
  const Vec3f grey{0.5f, 0.5f, 0.5f}, bright{4, 1, 0};
  EXPECT_EQ(tone_curve(bright, 0.5f, ToneCurve::clip), (Vec3f{1, 0.5f, 0}));
  EXPECT_NEAR(tone_curve(grey, 1, ToneCurve::reinhard).x, 1.0 / 3, 1e-6);
  // The luminance is 0.2126 x 4 + 0.7152 = 1.5656, so each channel is divided by 2.5656.
  const Vec3f r = tone_curve(bright, 1, ToneCurve::reinhard);
  EXPECT_NEAR(r.x, 1, 1e-6) << "4 / 2.5656 is more than a screen has";
  EXPECT_NEAR(r.y, 0.389772, 1e-5);
  EXPECT_NEAR(tone_curve(grey, 1, ToneCurve::filmic).x, 0.5 * (2.51 * 0.5 + 0.03) / (0.5 * (2.43 * 0.5 + 0.59) + 0.14), 1e-6);
  EXPECT_EQ(tone_curve(grey, 1, ToneCurve::neutral), tone_curve(grey, 1));
  for (const ToneCurve curve : kToneCurves) {
    EXPECT_EQ(tone_curve_named(name_of(curve)), curve);
    EXPECT_EQ(tone_curve({0, 0, 0}, 1, curve), (Vec3f{0, 0, 0}));
    float last = 0;
    for (float x = 0.01f; x < 100; x *= 1.1f) {
      const float y = tone_curve({x, x, x}, 1, curve).x;
      EXPECT_GE(y, last) << name_of(curve) << " at " << x;
      last = y;
    }
  }
  EXPECT_THROW(tone_curve_named("sepia"), UsageError);
}

TEST(Tone, RowsAreThePixelsOneByOne) {
  std::mt19937 random(2);
  std::lognormal_distribution<float> radiance(-1, 3);
  const float odd[] = {0, -0.0f, -3, INFINITY, -INFINITY, NAN, 1e-40f, 1e30f};
  for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{4}, std::size_t{4099}}) {
    std::vector<Vec3f> pixels(count);
    for (std::size_t i = 0; i < count; ++i) {
      pixels[i] = {radiance(random), radiance(random), radiance(random)};
      if (i % 3 == 0) pixels[i].x = odd[i / 3 % 8];
      if (i % 5 == 0) pixels[i].z = odd[i / 5 % 8];
    }
    std::vector<std::uint8_t> rgba(4 * count);
    for (const ToneCurve curve : kToneCurves) {
      tone_row(pixels.data(), count, 1.7f, rgba.data(), curve);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3f c = tone_curve(pixels[i], 1.7f, curve);
        ASSERT_EQ(rgba[4 * i], srgb_byte(c.x)) << i;
        ASSERT_EQ(rgba[4 * i + 1], srgb_byte(c.y)) << i;
        ASSERT_EQ(rgba[4 * i + 2], srgb_byte(c.z)) << i;
        ASSERT_EQ(rgba[4 * i + 3], 255);
      }
    }
  }
}

}  // namespace
}  // namespace steradian::image::tone_test
