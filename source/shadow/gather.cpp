#include "shadow/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace steradian::shadow {
namespace {

constexpr std::uint32_t kLeaf = 8;

Vec3d least(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d largest(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
double coordinate(Vec3d v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// Outward to float.
Vec3f below(Vec3d v) {
  const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity()); };
  return {down(v.x), down(v.y), down(v.z)};
}
Vec3f above(Vec3d v) { return -below(-v); }

}  // namespace

Shaft::Shaft(const LightFrame& frame, const std::vector<Vec3d>& points, Sections sections) : sections_(sections) {
  Vec3d low{INFINITY, INFINITY, INFINITY}, high = -low;
  for (const Vec3d& p : points) {
    low = least(low, frame.to_local(p));
    high = largest(high, frame.to_local(p));
  }
  const Vec3d half = (high - low) * 0.5;
  center_ = frame.to_world((low + high) * 0.5);
  half_[0] = frame.axes.x * half.x;
  half_[1] = frame.axes.y * half.y;
  half_[2] = frame.axes.z * half.z;

  origin_ = frame.origin;
  far_ = std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(low.z), std::fabs(high.x), std::fabs(high.y)});
  const double near = std::max(-high.z, 1e-12), far = std::max(-low.z, near);
  // The slanted side through the light's box at z = 0 and the points' box: which of its faces bounds depends on the slope.
  const auto slope = [&](double beyond) { return beyond / (beyond > 0 ? near : far); };
  const auto bound = [&](Vec3d normal, double offset) -> Bound {
    const Vec3d n = frame.axes.to_world(normal);
    const double d = offset + dot(n, frame.origin);
    return {n, d, length(n)};
  };
  bounds_ = {bound({0, 0, -1}, far),
             bound({0, 0, 1}, -frame.eta),
             bound({1, 0, slope(high.x - frame.box_x)}, frame.box_x),
             bound({-1, 0, slope(-low.x - frame.box_x)}, frame.box_x),
             bound({0, 1, slope(high.y - frame.box_y)}, frame.box_y),
             bound({0, -1, slope(-low.y - frame.box_y)}, frame.box_y)};
}

double Shaft::rounding(Vec3d p) const {
  const Vec3d d = p - origin_;
  return 2e-6 * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z) + far_) + 1e-12 * length(origin_);
}

bool Shaft::may_meet_box(Vec3d low, Vec3d high) const {
  const Vec3d c = (low + high) * 0.5, h = (high - low) * 0.5;
  const double margin = rounding(c) + 2e-6 * (h.x + h.y + h.z);
  return std::none_of(bounds_.begin(), bounds_.end(), [&](const Bound& b) {
    return dot(b.normal, c) - (std::fabs(b.normal.x) * h.x + std::fabs(b.normal.y) * h.y + std::fabs(b.normal.z) * h.z) >
           b.offset + margin * b.length;
  });
}

bool Shaft::may_meet(const Vec3d* corners, int count) const {
  return std::none_of(bounds_.begin(), bounds_.end(), [&](const Bound& b) {
    return std::all_of(corners, corners + count, [&](const Vec3d& c) { return dot(b.normal, c) > b.offset + rounding(c) * b.length; });
  });
}

bool Shaft::may_meet_segment(Vec3d a, Vec3d b) const {
  double t0 = 0, t1 = 1;
  for (const Bound& bound : bounds_) {
    const double da = dot(bound.normal, a) - bound.offset - rounding(a) * bound.length,
                 db = dot(bound.normal, b) - bound.offset - rounding(b) * bound.length;
    if (da > 0 && db > 0) return false;
    if (da > 0) t0 = std::max(t0, da / (da - db));
    if (db > 0) t1 = std::min(t1, da / (da - db));
  }
  return t0 <= t1;
}

int Shaft::facing(const Plane& plane) const {
  const double middle = dot(plane.normal, center_) - plane.offset;
  const double reach =
      std::fabs(dot(plane.normal, half_[0])) + std::fabs(dot(plane.normal, half_[1])) + std::fabs(dot(plane.normal, half_[2]));
  const double margin = reach + 1e-6 * (std::fabs(plane.offset) + length(plane.normal) * (length(center_) + 1e-3));
  return middle > margin ? 1 : middle < -margin ? -1 : 0;
}

bool Shaft::needs(const EdgeMesh& mesh, std::uint32_t number) const {
  const Edge& edge = mesh.edges[number];
  const Vec3d ends[2] = {mesh.vertices[edge.v0], mesh.vertices[edge.v1]};
  if (!may_meet(ends, 2)) return false;
  int weight = 0;
  for (std::uint32_t i = edge.first; i < edge.first + edge.count; ++i) {
    const int f = facing(mesh.planes[mesh.edge_triangles[i].triangle]);
    if (f == 0) return true;
    weight += mesh.edge_triangles[i].walks * f;
  }
  return weight != 0;
}

bool Shaft::needs_triangle(const EdgeMesh& mesh, std::uint32_t triangle) const {
  const auto& t = mesh.triangles[triangle];
  const Vec3d corners[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
  if (!may_meet(corners, 3)) return false;
  if (sections_ == Sections::anywhere) return true;
  // A large triangle may cross the plane far from the light.
  const Bound& plane = bounds_[1];
  Vec3d ends[3];
  int count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a = corners[i], b = corners[(i + 1) % 3];
    const double ha = dot(plane.normal, a) - plane.offset, hb = dot(plane.normal, b) - plane.offset;
    if ((ha < 0) != (hb < 0)) ends[count++] = a + (b - a) * (ha / (ha - hb));
  }
  return count != 2 || may_meet_segment(ends[0], ends[1]);
}

ShaftView Shaft::view_from(const LightFrame& frame) const {
  ShaftView view{};
  const auto put = [](float to[3], Vec3d v) {
    to[0] = static_cast<float>(v.x);
    to[1] = static_cast<float>(v.y);
    to[2] = static_cast<float>(v.z);
  };
  for (std::size_t i = 0; i < 6; ++i) {
    put(view.normal[i], frame.axes.to_local(bounds_[i].normal));
    const double offset = bounds_[i].offset - dot(bounds_[i].normal, frame.origin);
    view.offset[i] = static_cast<float>(offset + 1e-6 * std::fabs(offset));
  }
  put(view.middle, frame.to_local(center_));
  for (int i = 0; i < 3; ++i) put(view.half[i], frame.axes.to_local(half_[i]) * (1 + 1e-6));
  return view;
}

EdgeTree::EdgeTree(const EdgeMesh& mesh) : order_(mesh.edges.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (order_.empty()) return;
  nodes_.reserve(order_.size() / 2 + 1);
  nodes_.emplace_back();
  build(mesh, 0, 0, static_cast<std::uint32_t>(order_.size()));
}

void EdgeTree::build(const EdgeMesh& mesh, std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  Vec3d low{INFINITY, INFINITY, INFINITY}, high = -low, middle_low = low, middle_high = high;
  const auto twice_middle = [&](std::uint32_t e) { return mesh.vertices[mesh.edges[e].v0] + mesh.vertices[mesh.edges[e].v1]; };
  for (std::uint32_t i = begin; i < end; ++i) {
    const Edge& e = mesh.edges[order_[i]];
    const Vec3d a = mesh.vertices[e.v0], b = mesh.vertices[e.v1];
    low = least(low, least(a, b));
    high = largest(high, largest(a, b));
    middle_low = least(middle_low, a + b);
    middle_high = largest(middle_high, a + b);
  }
  nodes_[node].low = below(low);
  nodes_[node].high = above(high);
  const Vec3d size = middle_high - middle_low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (end - begin <= kLeaf || !(coordinate(size, axis) > 0)) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return coordinate(twice_middle(a), axis) < coordinate(twice_middle(b), axis); });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  build(mesh, children, begin, half);
  build(mesh, children + 1, half, end);
}

void EdgeTree::gather(const EdgeMesh& mesh, const Shaft& shaft, std::vector<std::uint32_t>& edges) const {
  edges.clear();
  if (nodes_.empty()) return;
  std::uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!shaft.may_meet_box(static_cast<Vec3d>(node.low), static_cast<Vec3d>(node.high))) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (shaft.needs(mesh, order_[i])) edges.push_back(order_[i]);
  }
  std::sort(edges.begin(), edges.end());
}

}  // namespace steradian::shadow
