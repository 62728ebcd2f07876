#include "core/mip_maps.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "steradian/kernels.h"
#include "support/random_configurations.h"

namespace steradian::mip_maps_test {
namespace {

using reference::Random;

// texel(x, y, channel): 0 to 255.
template <class Texel>
std::vector<Image> picture(int width, int height, Texel texel) {
  Image image{"", width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 4; ++c) image.rgba.push_back(static_cast<std::uint8_t>(texel(x, y, c)));
  return {image};
}

TextureUse use_of(ColorSpace space) {
  TextureUse use;
  use.image = 0;
  use.color_space = space;
  use.wrap_u = use.wrap_v = Wrap::clamp_to_edge;
  return use;
}

float any(Random& random, double from, double to) { return static_cast<float>(random.uniform(from, to)); }

}  // namespace

// Scenes in succession: images with the same texels keep their pyramid, and only those do.
TEST(MipMaps, TheSameTexelsKeepTheirPyramid) {
  const auto noise = [](int seed) {
    Random random(static_cast<std::uint64_t>(seed));
    return picture(20, 13, [&](int, int, int) { return random.uniform(0, 255.99); }).front();
  };
  const auto of = [](int image, ColorSpace space) {
    TextureUse use = use_of(space);
    use.image = image;
    return use;
  };
  MipMaps::Pyramids kept;
  const std::vector<Image> before = {noise(1), noise(2)};
  const auto first = std::make_unique<const MipMaps>(before, kept);
  const auto pyramid = first->pyramid(of(1, ColorSpace::srgb));
  const Image* second_level = first->levels(of(1, ColorSpace::srgb))[1];
  EXPECT_NE(pyramid, first->pyramid(of(1, ColorSpace::linear)));
  EXPECT_NE(pyramid, first->pyramid(of(0, ColorSpace::srgb)));

  std::vector<Image> after = {noise(2), noise(1), noise(2)};
  after[1].rgba[17] ^= 1;
  const MipMaps second(after, kept);
  for (const int image : {0, 2}) EXPECT_EQ(second.pyramid(of(image, ColorSpace::srgb)), pyramid);
  EXPECT_EQ(second.levels(of(0, ColorSpace::srgb))[0], &after[0]);
  EXPECT_EQ(second.levels(of(0, ColorSpace::srgb))[1], second_level);
  EXPECT_EQ(second_level->rgba, MipMaps(after).levels(of(0, ColorSpace::srgb))[1]->rgba);
  EXPECT_NE(second.pyramid(of(1, ColorSpace::srgb)), first->pyramid(of(0, ColorSpace::srgb)));

  std::vector<Image> turned = {noise(2)};
  std::swap(turned[0].width, turned[0].height);
  EXPECT_NE(MipMaps(turned, kept).pyramid(of(0, ColorSpace::srgb)), pyramid);
  EXPECT_EQ(kept.size(), 2u);  // only those of the last scene
}

// Every texel of every level is the area mean of the texels that it replaces, in linear light. It is stored in 8 bits, so it is off by at
// most half a code.
TEST(MipMaps, LevelsAreMeansByArea) {
  Random random(3);
  for (const auto& [width, height] : {std::pair{64, 32}, {37, 5}, {1, 19}, {3, 3}, {255, 130}}) {
    const auto images = picture(width, height, [&](int, int, int) { return random.uniform(0, 255.99); });
    const MipMaps maps(images);
    for (const ColorSpace space : {ColorSpace::linear, ColorSpace::srgb}) {
      const auto& levels = maps.levels(use_of(space));
      ASSERT_EQ(levels.front(), &images[0]);
      ASSERT_EQ(levels.back()->width * levels.back()->height, 1);
      double sum = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) sum += static_cast<double>(texel_of(images[0], x, y, space).y);
      // Half a code of sRGB is at most 0.5 / 255 * 2.275 in linear light.
      const double tolerance = 0.5 / 255 * (space == ColorSpace::srgb ? 2.275 : 1) + 1e-6;
      EXPECT_NEAR(static_cast<double>(texel_of(*levels.back(), 0, 0, space).y), sum / (width * height), tolerance);
      if (width % 4 != 0 || height % 4 != 0) continue;
      const Image& second = *levels[2];
      for (int y = 0; y < second.height; ++y)
        for (int x = 0; x < second.width; ++x) {
          double mean = 0;
          for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) mean += static_cast<double>(texel_of(images[0], 4 * x + i, 4 * y + j, space).z) / 16;
          ASSERT_NEAR(static_cast<double>(texel_of(second, x, y, space).z), mean, tolerance);
        }
    }
  }
}

// A texture that is locally linear has the mean of the footprint's middle, for any footprint that stays within it. The only error is the
// rounding of the levels to 8 bits.
TEST(MipMaps, RampsKeepTheirMiddle) {
  const auto images = picture(256, 256, [](int x, int y, int c) { return c == 0 ? x : c == 1 ? y : 255; });
  const MipMaps maps(images);
  const TextureUse use = use_of(ColorSpace::linear);
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const float reach = std::exp(any(random, -7, -2.2));
    const TextureFootprint footprint{{any(random, -reach, reach), any(random, -reach, reach)},
                                     {any(random, -reach, reach), any(random, -reach, reach)}};
    const Vec2f t{any(random, 0.4, 0.6), any(random, 0.4, 0.6)};
    const Vec4f found = sample_texture(maps, use, t, footprint);
    EXPECT_NEAR(static_cast<double>(found.x), (static_cast<double>(t.x) * 256 - 0.5) / 255, 0.5 / 255 + 1e-4);
    EXPECT_NEAR(static_cast<double>(found.y), (static_cast<double>(t.y) * 256 - 0.5) / 255, 0.5 / 255 + 1e-4);
    EXPECT_NEAR(static_cast<double>(found.w), 1, 1e-6);
  }
}

// Axes and coarseness, worked by hand: a footprint of 8 texels by 2, turned.
TEST(MipMaps, TapsLieAlongTheLongerAxis) {
  const double c = 0.6, s = 0.8, texel = 1.0 / 64;
  Kernels<double> k;
  const auto taps = k.texture_taps({64, 64}, {2 * texel * -s, 2 * texel * c}, {8 * texel * c, 8 * texel * s});
  EXPECT_TRUE(taps.covers.m);
  EXPECT_EQ(taps.count.v, 4);
  EXPECT_NEAR(taps.width.v, 2, 1e-12);
  EXPECT_NEAR(std::fabs(taps.axis.x.v), 8 * texel * c, 1e-12);
  EXPECT_NEAR(std::fabs(taps.axis.y.v), 8 * texel * s, 1e-12);
  EXPECT_FALSE(k.texture_taps({64, 64}, {0.4 * texel, 0}, {0, 0.4 * texel}).covers.m);
}

// Footprints that are not finite or exceed all bounds.
TEST(MipMaps, AnyFootprintGivesAColour) {
  Random random(9);
  const auto images = picture(20, 30, [&](int, int, int) { return random.uniform(0, 255.99); });
  const MipMaps maps(images);
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float a : {0.0f, 1e-30f, 1e-3f, 1.0f, 1e7f, 1e30f, inf, nan})
    for (const float b : {0.0f, 1e-30f, 1e-3f, 1.0f, 1e7f, 1e30f, inf, nan})
      for (const float t : {0.0f, 0.3f, -5.5f, 1e9f, inf, nan})
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
          TextureUse use = use_of(ColorSpace::srgb);
          use.wrap_u = wrap;
          const Vec4f c = sample_texture(maps, use, {t, 0.5f}, {{a, b}, {b, -a}});
          for (const float x : {c.x, c.y, c.z, c.w}) EXPECT_TRUE(x >= 0 && x <= 1.00001f) << a << " " << b << " " << t;
        }
}

}  // namespace steradian::mip_maps_test
