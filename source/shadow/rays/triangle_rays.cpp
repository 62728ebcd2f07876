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

TriangleRays::TriangleRays(const EdgeMesh& mesh) {
  Box3d all;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) all.add(box_of(mesh, t));
  // Corners are sums of `a` and a side: a rounding must not put a part of a triangle outside the box.
  const double margin = 2e-12 * (std::fabs(all.low.x) + std::fabs(all.low.y) + std::fabs(all.low.z) + length(all.size()));
  const auto grown = [&](std::uint32_t t) {
    const Box3d box = box_of(mesh, t);
    return Box3d{box.low - Box3d::all(margin), box.high + Box3d::all(margin)};
  };
  tree_ = BoxTree<Box3d>(mesh.triangles.size(), grown, Halving{4});
  for (const std::uint32_t number : tree_.order()) {
    const auto& t = mesh.triangles[number];
    const Vec3d a = mesh.vertices[t[0]];
    triangles_.push_back({a, mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a});
  }
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
