#include "image/flip.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "steradian/error.h"

namespace steradian::image::flip_test {
namespace {

// Values that tone_map takes to the same grey or colour, whatever it is.
Picture filled(int width, int height, Vec3f colour) {
  Picture picture(width, height);
  for (Vec3f& p : picture.pixels) p = colour;
  return picture;
}

TEST(Flip, EqualPicturesDoNotDiffer) {
  reference::Random random(3);
  Picture picture(24, 17);
  for (Vec3f& p : picture.pixels)
    p = {static_cast<float>(random.uniform()), static_cast<float>(random.uniform()), static_cast<float>(random.uniform())};
  const Flip f = flip(picture, picture, 0);
  for (const float e : f.error) EXPECT_LE(e, 1e-6f);
}

// Flat pictures have no features and nothing to filter: the error is section 3.4's of the two colours. Black and white differ in lightness
// by 100. Green and blue, the largest difference of the primaries after Hunt's adjustment, differ by 203.
TEST(Flip, BlackAndWhiteAreFarApart) {
  const Flip f = flip(filled(20, 20, {0, 0, 0}), filled(20, 20, {1e6f, 1e6f, 1e6f}), 0);
  EXPECT_NEAR(f.mean, 0.967, 0.003);
  for (const float e : f.error) EXPECT_NEAR(e, f.mean, 1e-5);
}

TEST(Flip, GrowsWithTheDifferenceAndDoesNotMindWhichIsWhich) {
  double last = 0;
  for (const float step : {0.01f, 0.05f, 0.2f}) {
    const Picture a = filled(20, 20, {0.3f, 0.3f, 0.3f}), b = filled(20, 20, {0.3f + step, 0.3f, 0.3f});
    const double error = flip(a, b, 0).mean;
    EXPECT_GT(error, last);
    EXPECT_NEAR(error, flip(b, a, 0).mean, 1e-7);
    last = error;
  }
}

// One lost pixel is a feature: it is visible, if it is large enough for the eye, and only there.
TEST(Flip, SeesAPointWhereItIs) {
  const Picture flat = filled(41, 41, {0.2f, 0.2f, 0.2f});
  Picture point = flat;
  point.at(20, 20) = {4, 4, 4};
  const Flip f = flip(point, flat, 0, 20);
  const auto at = [&](int x, int y) { return f.error[static_cast<std::size_t>(y * 41 + x)]; };
  EXPECT_GT(at(20, 20), 0.3f);
  EXPECT_LT(at(2, 2), 1e-3f);
  EXPECT_EQ(std::max_element(f.error.begin(), f.error.end()) - f.error.begin(), 20 * 41 + 20);
}

TEST(Flip, RefusesPicturesOfTwoSizes) { EXPECT_THROW(flip(Picture(3, 4), Picture(4, 3), 0), Error); }

}  // namespace
}  // namespace steradian::image::flip_test
