// Lobes of the bounce on bent metal, whose pixels share the virtual lights of a pattern.
#include <gtest/gtest.h>

#include <cmath>

#include "render/bounce/receivers/receivers.h"

namespace steradian::indirect::widen_test {
namespace {

constexpr int kSide = 8;
constexpr float kAlpha = 0.05f;

// A picture of 32 x 32 pixels whose normals turn by `step` [rad] a pixel to the right.
PictureSurfaces bent(float step, float f0) {
  PictureSurfaces s(Raster{32, 32});
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const std::size_t i = s.raster.at(x, y);
      s.normal.put(i, {std::sin(step * static_cast<float>(x)), 0, std::cos(step * static_cast<float>(x))});
      s.f0.put(i, {f0, f0, f0});
      s.alpha[i] = kAlpha;
    }
  return s;
}

float alpha_in_the_middle(float step, float f0) {
  PictureSurfaces s = bent(step, f0);
  widen_over_pattern(s, kSide);
  return s.alpha[s.raster.at(16, 16)];
}

}  // namespace

// Over four pixels the normal turns by 4 step; its chord is 2 sin(2 step), whose mean square over the pattern is a third of it. A float's
// cosine is good to 1e-7, its chord to 3e-4 of the least.
TEST(IndirectWiden, BentMetalIsAsWideAsItTurnsWithinThePattern) {
  for (const float step : {0.01f, 0.04f, 0.1f}) {
    const float chord = 2 * std::sin(2 * step);
    EXPECT_NEAR(alpha_in_the_middle(step, 0.9f), std::sqrt(kAlpha * kAlpha + chord * chord / 3), 3e-4f * chord) << step;
  }
}

TEST(IndirectWiden, FlatMetalEdgesAndDullSurfacesStayAsTheyAre) {
  EXPECT_EQ(alpha_in_the_middle(0, 0.9f), kAlpha);
  EXPECT_EQ(alpha_in_the_middle(0.04f, 0), kAlpha) << "no glossy lobe";
  EXPECT_EQ(alpha_in_the_middle(0.3f, 0.9f), kAlpha) << "69 degrees over four pixels: an edge";
}

}  // namespace steradian::indirect::widen_test
