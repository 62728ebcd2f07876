// Open shafts against segments between the points and the lights: no triangle may cut a segment of an open shaft.
#include "shadow/rays/shafts.h"

#include <gtest/gtest.h>
#include <random>

namespace steradian::shadow::open_shaft_test {
namespace {

using Random = std::mt19937;
double uniform(Random& random, double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
Vec3d in(Random& random, const Box3d& b) {
  return {uniform(random, b.low.x, b.high.x), uniform(random, b.low.y, b.high.y), uniform(random, b.low.z, b.high.z)};
}

bool cuts(const EdgeMesh& mesh, std::size_t triangle, Vec3d from, Vec3d to) {
  const auto& t = mesh.triangles[triangle];
  const Vec3d a = mesh.vertices[t[0]], u = mesh.vertices[t[1]] - a, v = mesh.vertices[t[2]] - a, d = to - from;
  const double volume = dot(d, cross(u, v));
  if (volume == 0) return false;
  const double s = dot(from - a, cross(u, v)) / -volume, x = dot(cross(from - a, d), v) / -volume, y = dot(cross(from - a, d), u) / volume;
  return s > 0 && s < 1 && x >= 0 && y >= 0 && x + y <= 1;
}

struct Group {
  std::vector<Vec3d> points;
  Box3d light;
};

// Points in the plane y = 0, on top of a triangle, or anywhere in a box, with a light above.
Group group(Random& random) {
  const bool flat = uniform(random, 0, 1) < 0.5;
  const Vec3d at{uniform(random, -3, 3), flat ? 1e-5 : uniform(random, 0.1, 1), uniform(random, -3, 3)};
  const Vec3d half{uniform(random, 0, 0.5), flat ? 0 : uniform(random, 0, 0.3), uniform(random, 0, 0.5)};
  Group g;
  for (int i = 0; i < 50; ++i) g.points.push_back(in(random, {at - half, at + half}));
  const Vec3d center{uniform(random, -3, 3), uniform(random, 1.5, 4), uniform(random, -3, 3)};
  const Vec3d size{uniform(random, 0, 0.8), uniform(random, 0, 0.3), uniform(random, 0, 0.8)};
  g.light = {center - size, center + size};
  return g;
}

EdgeMesh floor_and(int triangles, double size, Random& random) {
  std::vector<Vec3d> positions = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {-20, 0, -20}, {20, 0, 20}, {20, 0, -20}};
  const Box3d room{{-4, 0.2, -4}, {4, 4, 4}};
  for (int i = 0; i < triangles; ++i) {
    const Vec3d at = in(random, room), reach{size, size, size};
    for (int k = 0; k < 3; ++k) positions.push_back(in(random, {at - reach, at + reach}));
  }
  std::vector<std::uint32_t> indices(positions.size());
  for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
  return build_edges(positions, indices);
}

}  // namespace

TEST(OpenShaft, NoTriangleCutsASegmentOfAnOpenOne) {
  Random random(1);
  int open = 0, clear = 0, cut = 0, groups = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const EdgeMesh mesh = floor_and(scene % 3 == 0 ? 0 : scene, scene % 2 == 0 ? 0.2 : 1.5, random);
    const TriangleTree tree(mesh);
    TriangleTree::Viewers viewers;
    for (int k = 0; k < 40; ++k, ++groups) {
      const Group g = group(random);
      viewers.take(g.points);
      bool any = false;
      for (int ray = 0; ray < 400 && !any; ++ray) {
        const Vec3d from = g.points[random() % g.points.size()], to = in(random, g.light);
        for (std::size_t t = 0; t < mesh.triangles.size() && !any; ++t) any = cuts(mesh, t, from, to);
      }
      const bool is_open = tree.is_open(viewers, g.light, 0);
      EXPECT_FALSE(is_open && any) << "scene " << scene << ", group " << k;
      open += is_open;
      clear += !any;
      cut += any;
    }
  }
  std::printf("%d groups: %d open, %d of which no segment was cut, %d cut\n", groups, open, clear, cut);
  EXPECT_GT(cut, groups / 10);
  EXPECT_GT(open, clear / 2);  // at least half of the shafts that rays call free are known to be open
}

// A floor on which the points stand, and a ceiling that a light touches, are no occluders.
TEST(OpenShaft, SurfacesThatTouchItAreNoBlockers) {
  std::vector<Vec3d> positions = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {-5, 3, -5}, {5, 3, 5}, {-5, 3, 5}};
  const EdgeMesh mesh = build_edges(positions, {0, 1, 2, 3, 4, 5});
  const TriangleTree tree(mesh);
  TriangleTree::Viewers viewers;
  viewers.take({{-2, 1e-5, 2}, {-1, 1e-5, 3}, {-3, 1e-5, 3.5}});
  EXPECT_TRUE(tree.is_open(viewers, {{-3, 3, 2}, {-2, 3, 3}}, 0));
  // The light's box extends above the ceiling by less than the margin, and by more.
  EXPECT_TRUE(tree.is_open(viewers, {{-3, 3, 2}, {-2, 3 + 1e-6, 3}}, 1e-5));
  EXPECT_FALSE(tree.is_open(viewers, {{-3, 3, 2}, {-2, 3 + 1e-4, 3}}, 1e-5));
  // These points lie on both sides of the floor.
  viewers.take({{-2, 1e-5, 2}, {-1, -1e-5, 3}});
  EXPECT_FALSE(tree.is_open(viewers, {{-3, 3, 2}, {-2, 3, 3}}, 0));
}

TEST(OpenShaft, NothingBlocksWithoutTriangles) {
  const EdgeMesh mesh = build_edges(std::vector<Vec3d>{}, {});
  TriangleTree::Viewers viewers;
  viewers.take({{0, 0, 0}});
  EXPECT_TRUE(TriangleTree(mesh).is_open(viewers, {{1, 1, 1}, {2, 2, 2}}, 0));
}

}  // namespace steradian::shadow::open_shaft_test
