// Small entries left out: their exchange counts in the errors of rows.
#include <gtest/gtest.h>

#include <algorithm>

#include "steradian/view_factors.h"

namespace steradian::exchange::drop_test {
namespace {

// Facing squares at distances up to 20: factors from 0.2 down to 1e-3.
std::vector<ViewFactorFace> squares() {
  std::vector<ViewFactorFace> faces = {{"floor", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
  for (int i = 0; i < 20; ++i) {
    const double x = i, z = 1 + i % 3;
    faces.push_back({std::to_string(i), {{x, 0, z}, {x, 1, z}, {x + 1, 1, z}, {x + 1, 0, z}}});
  }
  return faces;
}

TEST(DroppedViewFactors, CountInTheErrorsOfTheirRows) {
  ViewFactorOptions options;
  options.obstruction = Obstruction::off;
  const ViewFactors all = view_factors(squares(), options);
  constexpr double kSmallest = 1e-2;
  const ViewFactors kept = without_small_factors(all, kSmallest);
  EXPECT_LT(kept.entries(), all.entries());
  EXPECT_GT(kept.entries(), 0u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    double sum = 0, left_out = 0;
    for (std::size_t j = 0; j < all.size(); ++j) {
      const double h = all.between(i, j);
      const bool is_small = h < kSmallest * std::min(all.areas[i], all.areas[j]);
      EXPECT_EQ(kept.between(i, j), is_small ? 0.0 : h) << i << " and " << j;
      EXPECT_EQ(kept.error_between(i, j), is_small ? 0.0 : all.error_between(i, j));
      (is_small ? left_out : sum) += h / all.areas[i];
    }
    // Sums of 20 numbers below 1 in another order.
    constexpr double kRounding = 20 * 2.3e-16;
    EXPECT_NEAR(kept.row_sums[i], sum, kRounding);
    EXPECT_NEAR(kept.row_errors[i], all.row_errors[i] + left_out, kRounding);
  }
  EXPECT_EQ(without_small_factors(all, 0).entries(), all.entries());
}

}  // namespace
}  // namespace steradian::exchange::drop_test
