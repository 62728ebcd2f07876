#include "shapes/plane_region.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"

namespace steradian::plane_region_test {
namespace {

// A polygon's part in a box, by clipping with each side in turn (Sutherland and Hodgman).
std::vector<Vec2d> clipped(std::vector<Vec2d> p, const Box2d& box) {
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
  return p;
}

// Area and first moments, as a sum of triangles about the origin.
struct Moments {
  double area = 0;
  Vec2d sum{0, 0};
};
Moments moments_of(const std::vector<Vec2d>& p) {
  Moments m;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2d a = p[i], b = p[(i + 1) % p.size()];
    const double area = 0.5 * cross(a, b);
    m.area += area;
    m.sum = m.sum + (a + b) * (area / 3);
  }
  return m;
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
    const Moments want = moments_of(clipped(corners, box));
    EXPECT_NEAR(region.area_in(box), want.area, 1e-12) << i;
    // One row of the region serves all of the row's boxes.
    PlaneRegion row;
    region.cut_row(box.low.y, box.high.y, row);
    const PlaneRegion::Part part = row.part_in(box);
    EXPECT_NEAR(part.area, want.area, 1e-12) << i;
    EXPECT_NEAR(part.area * part.centroid.x, want.sum.x, 1e-12) << i;
    EXPECT_NEAR(part.area * part.centroid.y, want.sum.y, 1e-12) << i;
    // A turn moves the whole region, and the part within its bounds is all of it.
    const double angle = 2 * M_PI * random.uniform();
    const Vec2d x = {std::cos(angle), std::sin(angle)};
    const PlaneRegion turned = region.turned(x);
    const PlaneRegion::Part all = turned.part_in(turned.bounds());
    const Moments whole = moments_of(corners);
    EXPECT_NEAR(all.area, whole.area, 1e-12) << i;
    EXPECT_NEAR(all.area * (all.centroid.x * x.x - all.centroid.y * x.y), whole.sum.x, 1e-12) << i;
    EXPECT_NEAR(all.area * (all.centroid.x * x.y + all.centroid.y * x.x), whole.sum.y, 1e-12) << i;
  }
}

}  // namespace
}  // namespace steradian::plane_region_test
