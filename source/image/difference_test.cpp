#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "steradian/compare.h"
#include "steradian/error.h"

namespace steradian::difference_test {

TEST(Difference, OfKnownPictures) {
  Picture a(2, 1), b(2, 1);
  a.at(0, 0) = {1, 2, 3};
  a.at(1, 0) = {0, 0, 0};
  b.at(0, 0) = {1, 2, 1};
  b.at(1, 0) = {0, 2, 0};
  const Difference d = difference(a, b);
  EXPECT_DOUBLE_EQ(d.rmse, std::sqrt(8.0 / 6.0));
  EXPECT_DOUBLE_EQ(d.relative_l2, std::sqrt(8.0 / 10.0));
  EXPECT_DOUBLE_EQ(d.max, 2.0);
  EXPECT_EQ(d.max_x, 0);
  EXPECT_DOUBLE_EQ(d.mean_ratio, 1.0);
}

TEST(Difference, OfBlackPicturesIsZero) {
  const Difference d = difference(Picture(3, 3), Picture(3, 3));
  EXPECT_EQ(d.rmse, 0.0);
  EXPECT_EQ(d.relative_l2, 0.0);
  EXPECT_EQ(d.mean_ratio, 1.0);
}

TEST(Difference, IsCoveredByErrorLayersAndVariance) {
  Picture a(2, 2), b(2, 2);
  a.layers["e"] = {{0.1f, 0.1f, 0.1f}, {}, {}, {0.2f, 0, 0}};
  b.layers["variance"] = {{}, {0.01f, 0, 0}, {}, {}};
  a.at(0, 0) = {0.1f, 0, 0.05f};  // within the layer
  a.at(1, 0) = {0.39f, 0, 0};     // within four standard errors
  a.at(1, 1) = {0.5f, 0, 0};      // 2.5 times the layer
  const Coverage c = coverage(a, b, {"e"});
  EXPECT_DOUBLE_EQ(c.fraction, 0.75);
  EXPECT_NEAR(c.worst, 2.5, 1e-6);
  EXPECT_EQ(c.worst_x, 1);
  EXPECT_EQ(c.worst_y, 1);
  EXPECT_DOUBLE_EQ(coverage(a, b, {}).fraction, 0.5);
  EXPECT_THROW(coverage(a, b, {"f"}), Error);
}

TEST(Difference, RefusesOtherSizesAndNonFinitePixels) {
  EXPECT_THROW(difference(Picture(2, 2), Picture(2, 3)), Error);
  Picture bad(1, 1);
  bad.at(0, 0).y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(difference(bad, Picture(1, 1)), Error);
}

}  // namespace steradian::difference_test
