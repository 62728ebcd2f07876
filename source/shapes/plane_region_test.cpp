#include "shapes/plane_region.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace steradian::plane_region_test {
namespace {

// The area of a polygon's part in a box, by clipping with each side in turn (Sutherland and Hodgman).
double clipped_area(std::vector<Vec2d> p, const Box2d& box) {
  const auto clip = [&](auto inside) {
    std::vector<Vec2d> out;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec2d a = p[i], b = p[(i + 1) % p.size()];
      const double da = inside(a), db = inside(b);
      if (da >= 0) out.push_back(a);
      if ((da >= 0) != (db >= 0)) out.push_back(a + (b - a) * (da / (da - db)));
    }
    p = out;
  };
  clip([&](Vec2d q) { return q.x - box.low.x; });
  clip([&](Vec2d q) { return box.high.x - q.x; });
  clip([&](Vec2d q) { return q.y - box.low.y; });
  clip([&](Vec2d q) { return box.high.y - q.y; });
  double area = 0;
  for (std::size_t i = 0; i < p.size(); ++i) area += 0.5 * cross(p[i], p[(i + 1) % p.size()]);
  return area;
}

TEST(PlaneRegion, AgreesWithClippedPolygons) {
  reference::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    // A star-shaped outline, so that it does not cross itself.
    std::vector<Vec2d> corners;
    const int count = 3 + static_cast<int>(random.uniform() * 6);
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * M_PI * (k + 0.9 * random.uniform()) / count, r = 0.2 + random.uniform();
      corners.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    PlaneRegion region;
    for (std::size_t k = 0; k < corners.size(); ++k) region.add(corners[k], corners[(k + 1) % corners.size()]);
    Box2d box;
    for (int k = 0; k < 2; ++k) box.add(Vec2d{2 * random.uniform() - 1, 2 * random.uniform() - 1});
    EXPECT_NEAR(region.area_in(box), clipped_area(corners, box), 1e-12) << i;
  }
}

}  // namespace
}  // namespace steradian::plane_region_test
