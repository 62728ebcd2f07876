#include "integrals/tables/table.h"

#include <cmath>
#include <gtest/gtest.h>

namespace steradian::half_test {

TEST(Half, EveryFiniteHalfComesBack) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    if ((bits & 0x7c00) == 0x7c00) continue;
    const auto h = static_cast<std::uint16_t>(bits);
    ASSERT_EQ(half_from_float(float_from_half(h)), h) << bits;
  }
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
  for (unsigned bits = 0; bits + 1 < 0x7c00; ++bits) {
    const float a = float_from_half(static_cast<std::uint16_t>(bits)), b = float_from_half(static_cast<std::uint16_t>(bits + 1));
    const float middle = 0.5f * (a + b);
    ASSERT_EQ(half_from_float(middle), bits % 2 ? bits + 1 : bits) << bits;
    ASSERT_EQ(half_from_float(std::nextafter(middle, a)), bits) << bits;
    ASSERT_EQ(half_from_float(std::nextafter(middle, b)), bits + 1) << bits;
  }
}

TEST(Half, OverflowsToInfinityAndKeepsNan) {
  EXPECT_EQ(half_from_float(65519.0f), 0x7bff);
  EXPECT_EQ(half_from_float(65520.0f), 0x7c00);
  EXPECT_EQ(half_from_float(-1e30f), 0xfc00);
  EXPECT_TRUE(std::isnan(float_from_half(half_from_float(NAN))));
}

}  // namespace steradian::half_test
