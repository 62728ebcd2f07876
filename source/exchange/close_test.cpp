// Closed enclosures: rows that add up to 1, within the errors of the entries.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "steradian/error.h"
#include "steradian/view_factors.h"

namespace steradian::exchange::close_test {
namespace {

// The inside of a box of 1 x 2 x 3 with n x n elements a side.
std::vector<ViewFactorFace> inside_of_box(int n, bool has_lid) {
  std::vector<ViewFactorFace> faces;
  const Vec3d x{1, 0, 0}, y{0, 2, 0}, z{0, 0, 3};
  const auto add = [&](Vec3d corner, Vec3d a, Vec3d b) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto at = [&](int s, int t) { return corner + a * (static_cast<double>(s) / n) + b * (static_cast<double>(t) / n); };
        faces.push_back({"", {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
  };
  add({}, x, y);
  add({}, y, z);
  add(x, z, y);
  add({}, z, x);
  add(y, x, z);
  if (has_lid) add(z, y, x);
  return faces;
}

TEST(ClosedViewFactors, AddUpToOneAndMoveWithinTheErrors) {
  ViewFactorOptions options;
  options.eps = 1e-3;
  const ViewFactors open = view_factors(inside_of_box(5, true), options), closed = closed_view_factors(open);
  double gap = 0, moved = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    gap = std::max(gap, std::fabs(open.row_sums[i] - 1));
    EXPECT_NEAR(closed.row_sums[i], 1, 1e-14) << i;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(closed.between(i, j), 0);
      if (open.error_between(i, j) > 0)
        moved = std::max(moved, std::fabs(closed.between(i, j) - open.between(i, j)) / open.error_between(i, j));
    }
  }
  EXPECT_GT(gap, 1e-9);  // else there was nothing to correct
  EXPECT_LE(moved, 1);
}

TEST(ClosedViewFactors, RefuseAnEnclosureWithAHole) { EXPECT_THROW(closed_view_factors(view_factors(inside_of_box(2, false))), Error); }

}  // namespace
}  // namespace steradian::exchange::close_test
