#include "shadow/rays/triangle_rays.h"

#include <algorithm>
#include <cmath>

namespace steradian::shadow {
namespace {

// Moeller, Trumbore, "Fast, minimum storage ray-triangle intersection", 1997, for 0 <= t <= 1.
template <class Triangle>
bool meets(const Triangle& t, Vec3d from, Vec3d d) {
  const Vec3d p = cross(d, t.ac);
  const double det = dot(t.ab, p);
  if (det == 0) return false;
  const Vec3d s = from - t.a;
  const double u = dot(s, p) / det;
  if (!(u >= 0 && u <= 1)) return false;
  const Vec3d q = cross(s, t.ab);
  const double v = dot(d, q) / det;
  if (!(v >= 0 && u + v <= 1)) return false;
  const double at = dot(t.ac, q) / det;
  return at >= 0 && at <= 1;
}

bool meets_box(const Box3d& box, Vec3d from, Vec3d inverse) {
  double near = 0, far = 1;
  const auto slab = [&](double l, double h, double o, double i) {
    const double a = (l - o) * i, b = (h - o) * i;
    near = std::fmax(near, std::fmin(a, b));  // fmin and fmax ignore 0 times infinity
    far = std::fmin(far, std::fmax(a, b));
  };
  slab(box.low.x, box.high.x, from.x, inverse.x);
  slab(box.low.y, box.high.y, from.y, inverse.y);
  slab(box.low.z, box.high.z, from.z, inverse.z);
  return near <= far * (1 + 1e-12);
}

}  // namespace

// The boxes decide about rays that lie in the plane of a triangle but for roundings. So the halves are not those of Halving.
TriangleRays::TriangleRays(const EdgeMesh& mesh) {
  std::vector<Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]];
    triangles.push_back({a, mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a});
  }
  const auto box = [&](std::uint32_t i) {
    const Triangle& t = triangles[i];
    Box3d result;
    for (const Vec3d v : {t.a, t.a + t.ab, t.a + t.ac}) result.add(v);
    return result;
  };
  const auto center = [&](const BoxTree<Box3d>::Item& i) {
    return triangles[i.number].a + (triangles[i.number].ab + triangles[i.number].ac) / 3.0;
  };
  const auto halve = [&](std::span<BoxTree<Box3d>::Item> items) -> std::size_t {
    Box3d centers;
    for (const auto& i : items) centers.add(center(i));
    const int axis = centers.longest_side();
    if (items.size() <= 4 || !(coordinate(centers.size(), axis) > 0)) return 0;
    const auto half = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), half, items.end(),
                     [&](const auto& a, const auto& b) { return coordinate(center(a), axis) < coordinate(center(b), axis); });
    return items.size() / 2;
  };
  tree_ = BoxTree<Box3d>(triangles.size(), box, halve);
  // Corners are summed again here: a rounding must not put a part of a triangle outside the box.
  tree_.change([](const Box3d& b) {
    const double margin = 1e-12 * (std::fabs(b.low.x) + std::fabs(b.low.y) + std::fabs(b.low.z) + length(b.size()));
    return Box3d{b.low - Box3d::all(margin), b.high + Box3d::all(margin)};
  });
  for (const std::uint32_t i : tree_.order()) triangles_.push_back(triangles[i]);
}

bool TriangleRays::between(Vec3d from, Vec3d to) const {
  const Vec3d d = to - from, inverse{1 / d.x, 1 / d.y, 1 / d.z};
  return tree_.any_leaf([&](const auto& node) { return meets_box(node.volume, from, inverse); },
                        [&](std::uint32_t first, std::uint32_t last) {
                          return std::any_of(triangles_.begin() + first, triangles_.begin() + last,
                                             [&](const Triangle& t) { return meets(t, from, d); });
                        });
}

}  // namespace steradian::shadow
