#include "scene/emitters/merge_polygons.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "steradian/polygon_light.h"

namespace steradian::scene::merge_polygons_test {
namespace {

MergedPolygons merge(const std::vector<Triangle>& t) {
  return merge_coplanar(t, [](std::size_t, std::size_t) { return true; });
}

double area_of(const MergedPolygon& p) { return prepare_polygon({p.outline, p.holes, {1, 1, 1}, false}).area; }

// n x n unit cells in z = 0 without the cells for which left_out(i, j) is true.
template <class LeftOut>
std::vector<Triangle> grid(int n, LeftOut left_out) {
  std::vector<Triangle> result;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (left_out(i, j)) continue;
      const Vec3d a{1.0 * i, 1.0 * j, 0}, b{i + 1.0, 1.0 * j, 0}, c{i + 1.0, j + 1.0, 0}, d{1.0 * i, j + 1.0, 0};
      result.push_back({a, b, c});
      result.push_back({a, c, d});
    }
  return result;
}

TEST(MergePolygons, MakesAGridOneRectangleWithFourCorners) {
  const auto merged = merge(grid(7, [](int, int) { return false; }));
  ASSERT_EQ(merged.polygons.size(), 1u);
  EXPECT_EQ(merged.polygons[0].outline.size(), 4u);
  EXPECT_EQ(merged.polygons[0].triangles.size(), 98u);
  EXPECT_NEAR(area_of(merged.polygons[0]), 49, 1e-12);
}

TEST(MergePolygons, MakesATurnedFineGridOfSinglePrecisionOneRectangle) {
  // A small triangle's own plane is known only to the rounding of its corners over its size. It misses the other end of the grid by more
  // than the tolerance. So the plane must be the patch's.
  for (const int n : {16, 64, 200})
    for (const double scale : {0.001, 1.0, 50.0}) {
      const Frame frame = Frame::from_normal(normalized(Vec3d{0.3, 0.8, -0.5}));
      std::vector<Triangle> turned = grid(n, [](int, int) { return false; });
      for (Triangle& t : turned)
        for (Vec3d& v : t) {
          const Vec3d in_world = Vec3d{0.4, -1.7, 0.9} * scale + frame.to_world(v) * (scale / n);
          v = static_cast<Vec3d>(static_cast<Vec3f>(in_world));
        }
      const auto merged = merge(turned);
      ASSERT_EQ(merged.polygons.size(), 1u) << n << " " << scale;
      EXPECT_NEAR(area_of(merged.polygons[0]), scale * scale, 1e-6 * scale * scale);
    }
}

TEST(MergePolygons, KeepsHoles) {
  const auto merged = merge(grid(7, [](int i, int j) { return (i == 2 && j == 2) || (i >= 4 && i <= 5 && j == 4); }));
  ASSERT_EQ(merged.polygons.size(), 1u);
  EXPECT_EQ(merged.polygons[0].outline.size(), 4u);
  EXPECT_EQ(merged.polygons[0].holes.size(), 2u);
  EXPECT_NEAR(area_of(merged.polygons[0]), 46, 1e-12);
}

TEST(MergePolygons, LeavesAPatchThatTouchesItselfInACornerAsTriangles) {
  // Two missing cells share a corner, so the assignment of the holes is ambiguous.
  const auto merged = merge(grid(5, [](int i, int j) { return (i == 1 && j == 1) || (i == 2 && j == 2); }));
  EXPECT_EQ(merged.polygons.size(), 46u);
  double area = 0;
  for (const auto& p : merged.polygons) area += area_of(p);
  EXPECT_NEAR(area, 23, 1e-12);
}

TEST(MergePolygons, SeparatesPlanesAndBacks) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0}, e{1, 0, 1};
  EXPECT_EQ(merge({{a, b, c}, {a, c, d}}).polygons.size(), 1u);
  EXPECT_EQ(merge({{a, b, c}, {c, b, a}}).polygons.size(), 2u) << "front and back of one triangle";
  EXPECT_EQ(merge({{a, b, c}, {b, e, c}}).polygons.size(), 2u) << "two sides of a box";
}

TEST(MergePolygons, DoesNotJoinAcrossAnEdgeOfThreeTriangles) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, -1, 0}, e{1, -1, 0};
  const auto merged = merge({{a, b, c}, {b, a, d}, {b, a, e}});
  EXPECT_EQ(merged.polygons.size(), 3u);
}

TEST(MergePolygons, CountsTrianglesWithoutArea) {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{2, 0, 0};
  const auto merged = merge({{a, b, c}, {a, a, b}});
  EXPECT_EQ(merged.without_area, 2u);
  EXPECT_TRUE(merged.polygons.empty());
}

TEST(MergePolygons, KeepsEveryTriangleOfACurvedSurfaceOnce) {
  std::vector<Triangle> triangles;  // a cylinder of 64 flat strips
  const auto at = [](int i, double z) {
    return Vec3d{std::cos(i % 64 * std::numbers::pi / 32), std::sin(i % 64 * std::numbers::pi / 32), z};
  };
  for (int i = 0; i < 64; ++i) {
    triangles.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1)});
    triangles.push_back({at(i, 0), at(i + 1, 1), at(i, 1)});
  }
  const auto merged = merge(triangles);
  EXPECT_EQ(merged.polygons.size(), 64u);
  std::size_t count = 0;
  for (const auto& p : merged.polygons) count += p.triangles.size();
  EXPECT_EQ(count, 128u);
}

}  // namespace
}  // namespace steradian::scene::merge_polygons_test
