// One fit for 8 x 8 pixels: it serves planes, and neither steps nor bends.
#include "render/radiosity/block_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace steradian::radiosity {
namespace {

using Means = std::array<std::array<Gathered, BlockFit::kLanes>, 4>;
using Fitted = std::array<std::array<FittedValue, BlockFit::kLanes>, 4>;

constexpr double kNoise = 0.01;  // standard deviation; the light is about 1

// Calls use(block, lane, x, y) for all pixels.
template <class Use>
void each_pixel(Use use) {
  for (std::size_t b = 0; b < 4; ++b)
    for (std::size_t i = 0; i < BlockFit::kLanes; ++i)
      use(b, i, static_cast<double>(b % 2 * 4 + i % 4), static_cast<double>(b / 2 * 4 + i / 4));
}

// Values of a function with noise whose deviation is known.
template <class Light>
Means noisy(Light light, std::uint64_t seed) {
  reference::Random random(seed);
  Means means;
  each_pixel([&](std::size_t b, std::size_t i, double x, double y) {
    const auto value = static_cast<float>(light(x, y) + kNoise * std::sqrt(12.0) * (random.uniform() - 0.5));
    means[b][i] = {{value, value, value}, {static_cast<float>(kNoise), static_cast<float>(kNoise), static_cast<float>(kNoise)}};
  });
  return means;
}

double plane(double x, double y) { return 1 + 0.02 * x - 0.01 * y; }

}  // namespace

// The noise averages out: 64 values and three parameters leave sqrt(3 / 64) of it in the mean over the pixels.
TEST(BlockFit, ServesPlanesByOneFit) {
  int served = 0;
  double squares = 0;
  constexpr int kSeeds = 200;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Fitted fitted;
    if (!fit_square(noisy(plane, static_cast<std::uint64_t>(seed)), fitted)) continue;
    ++served;
    each_pixel([&](std::size_t b, std::size_t i, double x, double y) {
      squares += std::pow(static_cast<double>(fitted[b][i].value.x) - plane(x, y), 2) / 64;
      EXPECT_NEAR(static_cast<double>(fitted[b][i].standard.x), kNoise * std::sqrt(3.0 / 64), 0.4 * kNoise * std::sqrt(3.0 / 64));
    });
  }
  EXPECT_GE(served, kSeeds * 97 / 100);  // by chance one of a thousand is refused
  // Slopes shrink a little towards 0: they are 18 and 36 times their own deviation.
  EXPECT_LT(std::sqrt(squares / served), 1.2 * kNoise * std::sqrt(3.0 / 64));
}

TEST(BlockFit, RefusesStepsAndBends) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Fitted fitted;
    EXPECT_FALSE(fit_square(noisy([](double x, double y) { return plane(x, y) + (x > 5.5 ? 8 * kNoise : 0); }, seed), fitted)) << seed;
    EXPECT_FALSE(fit_square(noisy([](double x, double y) { return plane(x, y) + 0.4 * kNoise * x * x; }, seed), fitted)) << seed;
    // One pixel beside all others.
    EXPECT_FALSE(fit_square(noisy([](double x, double y) { return plane(x, y) + (x == 3 && y == 5 ? 25 * kNoise : 0); }, seed), fitted))
        << seed;
  }
}

// Few pixels see a small light: one of eight, or none.
TEST(BlockFit, RefusesRareLight) {
  for (const float light : {0.0f, 1.0f}) {
    Means means;
    each_pixel([&](std::size_t b, std::size_t i, double, double) {
      const float value = i % 8 == b ? light : 0;
      means[b][i] = {{value, value, value}, {light, light, light}};
    });
    Fitted fitted;
    EXPECT_FALSE(fit_square(means, fitted)) << light;
  }
}

// A plane through the pixels with even coordinates holds those between them, too.
TEST(BlockFit, IsLinearBetweenEvenPixels) {
  const auto value = [](std::size_t x, std::size_t y) { return 2 + 0.25f * static_cast<float>(x) - 0.125f * static_cast<float>(y); };
  std::array<FittedValue, BlockFit::kLanes> even;
  for (std::size_t i = 0; i < even.size(); ++i) even[i] = {{value(i % 4 * 2, i / 4 * 2), 0, 0}, {1, 0, 0}, {1, 0, 0}};
  for (std::size_t y = 0; y < 8; ++y)
    for (std::size_t x = 0; x < 8; ++x) {
      const FittedValue between = between_even_pixels(even, x, y);
      EXPECT_EQ(between.value.x, value(std::min(x, std::size_t{6}), std::min(y, std::size_t{6}))) << x << " " << y;  // multiples of 1/16
      EXPECT_EQ(between.error.x, 1);
    }
}

}  // namespace steradian::radiosity
