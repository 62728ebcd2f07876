#include "shadow/rays/triangle_rays.h"

#include <algorithm>
#include <cmath>

#include "core/box.h"

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

bool meets_box(Vec3d low, Vec3d high, Vec3d from, Vec3d inverse) {
  double near = 0, far = 1;
  const auto slab = [&](double l, double h, double o, double i) {
    const double a = (l - o) * i, b = (h - o) * i;
    near = std::fmax(near, std::fmin(a, b));  // fmin and fmax ignore 0 times infinity
    far = std::fmin(far, std::fmax(a, b));
  };
  slab(low.x, high.x, from.x, inverse.x);
  slab(low.y, high.y, from.y, inverse.y);
  slab(low.z, high.z, from.z, inverse.z);
  return near <= far * (1 + 1e-12);
}

}  // namespace

TriangleRays::TriangleRays(const EdgeMesh& mesh) {
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]];
    triangles_.push_back({a, mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a});
  }
  if (triangles_.empty()) return;
  nodes_.reserve(2 * triangles_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

void TriangleRays::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  Box3d box, centers;
  const auto center = [](const Triangle& t) { return t.a + (t.ab + t.ac) / 3.0; };
  for (std::uint32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[i];
    for (const Vec3d v : {t.a, t.a + t.ab, t.a + t.ac}) box.add(v);
    centers.add(center(t));
  }
  // Corners are summed again here: a rounding must not put a part of a triangle outside the box.
  const double margin = 1e-12 * (std::fabs(box.low.x) + std::fabs(box.low.y) + std::fabs(box.low.z) + length(box.size()));
  const Vec3d grow{margin, margin, margin};
  nodes_[node].low = box.low - grow;
  nodes_[node].high = box.high + grow;
  const int axis = centers.longest_side();
  if (end - begin <= 4 || !(coordinate(centers.size(), axis) > 0)) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
                   [&](const Triangle& a, const Triangle& b) { return coordinate(center(a), axis) < coordinate(center(b), axis); });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, begin, middle);
  build(children + 1, middle, end);
}

bool TriangleRays::between(Vec3d from, Vec3d to) const {
  if (nodes_.empty()) return false;
  const Vec3d d = to - from, inverse{1 / d.x, 1 / d.y, 1 / d.z};
  std::uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!meets_box(node.low, node.high, from, inverse)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (meets(triangles_[i], from, d)) return true;
  }
  return false;
}

}  // namespace steradian::shadow
