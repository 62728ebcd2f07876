#include "render/cpu/camera_rays.h"

#include <gtest/gtest.h>

#include <set>

namespace steradian::camera_rays_test {
namespace {

// Each of `count` columns and rows holds one place, in its middle. Their mean is therefore the pixel's centre, except for float roundings.
TEST(CameraRays, PlacesInAPixelAreEvenAndDoNotMoveThePicture) {
  for (const int count : {1, 2, 3, 4, 7, 16, 64, 100}) {
    double x = 0, y = 0;
    std::set<int> columns, rows;
    for (int i = 0; i < count; ++i) {
      const PixelPlace p = pixel_place(i, count);
      x += static_cast<double>(p.x) / count;
      y += static_cast<double>(p.y) / count;
      columns.insert(static_cast<int>(p.x * static_cast<float>(count)));
      rows.insert(static_cast<int>(p.y * static_cast<float>(count)));
    }
    EXPECT_NEAR(x, 0.5, 1e-7) << count;
    EXPECT_NEAR(y, 0.5, 1e-7) << count;
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
  }
}

// Every quarter of the pixel has its number of places, to one and a half.
TEST(CameraRays, PlacesInAPixelFillItsQuarters) {
  for (int count = 4; count <= 64; ++count) {
    int quarters[4] = {};
    for (int i = 0; i < count; ++i) {
      const PixelPlace p = pixel_place(i, count);
      ++quarters[(p.x < 0.5f ? 0 : 1) + (p.y < 0.5f ? 0 : 2)];
    }
    for (const int n : quarters) EXPECT_NEAR(n, count / 4.0, 1.5) << count;
  }
}

}  // namespace
}  // namespace steradian::camera_rays_test
