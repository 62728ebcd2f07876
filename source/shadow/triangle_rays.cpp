#include "shadow/triangle_rays.h"

#include <algorithm>
#include <cmath>

namespace steradian::shadow {
namespace {

Vec3d least(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d largest(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

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
    near = std::fmax(near, std::fmin(a, b));  // fmin and fmax pass over 0 times infinity
    far = std::fmin(far, std::fmax(a, b));
  };
  slab(low.x, high.x, from.x, inverse.x);
  slab(low.y, high.y, from.y, inverse.y);
  slab(low.z, high.z, from.z, inverse.z);
  return near <= far * (1 + 1e-12);
}

double coordinate(Vec3d v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

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
  Vec3d low{INFINITY, INFINITY, INFINITY}, high = -low, center_low = low, center_high = high;
  const auto center = [](const Triangle& t) { return t.a + (t.ab + t.ac) / 3.0; };
  for (std::uint32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[i];
    for (const Vec3d v : {t.a, t.a + t.ab, t.a + t.ac}) {
      low = least(low, v);
      high = largest(high, v);
    }
    center_low = least(center_low, center(t));
    center_high = largest(center_high, center(t));
  }
  const Vec3d size = center_high - center_low;
  // Corners are summed again here: a box must not cut a triangle by a rounding.
  const double margin = 1e-12 * (std::fabs(low.x) + std::fabs(low.y) + std::fabs(low.z) + length(high - low));
  const Vec3d grow{margin, margin, margin};
  nodes_[node].low = low - grow;
  nodes_[node].high = high + grow;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (end - begin <= 4 || !(coordinate(size, axis) > 0)) {
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
