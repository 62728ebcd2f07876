#include "render/shadow/open_lights.h"

#include <algorithm>
#include <cmath>

#include "core/box.h"

namespace steradian {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

}  // namespace

OpenLights::OpenLights(const std::vector<PackLight>& lights, const shadow::TriangleTree& triangles, const std::vector<Box3d>& cut_outs)
    : triangles_(triangles), cut_outs_(cut_outs), leaf_of_(lights.size(), kNone) {
  std::vector<Node> leaves;
  for (const PackLight& light : lights) {
    const auto* punctual = std::get_if<packed::Punctual>(&light.shape);
    if (punctual != nullptr && punctual->kind == PunctualKind::directional) continue;
    Node leaf;
    leaf.is_leaf = true;
    leaf.light = static_cast<std::uint32_t>(light.index);
    leaf.margin = light.is_polygon() ? shadow::margin_of_plane(light.polygon) : 0;
    if (light.is_polygon()) {
      for (const Vec3d& v : light.polygon.vertices) leaf.box.add(v);
    } else {
      std::visit(
          [&](const auto& shape) {
            shape.any_bound([&](Vec3f p, float r) {
              const auto c = static_cast<Vec3d>(p);
              const double d = static_cast<double>(r) * (1 + 1e-6);
              leaf.box.add({c - Vec3d{d, d, d}, c + Vec3d{d, d, d}});
              return false;
            });
          },
          light.shape);
    }
    leaves.push_back(leaf);
  }
  if (leaves.empty()) return;
  nodes_.emplace_back();
  build(0, leaves, 0, leaves.size());
}

void OpenLights::build(std::uint32_t node, std::vector<Node>& leaves, std::size_t begin, std::size_t end) {
  const std::uint32_t parent = nodes_[node].parent;
  if (end - begin == 1) {
    nodes_[node] = leaves[begin];
    nodes_[node].parent = parent;
    leaf_of_[leaves[begin].light] = node;
    return;
  }
  Box3d box;
  double margin = INFINITY;
  for (std::size_t i = begin; i < end; ++i) {
    box.add(leaves[i].box);
    margin = std::min(margin, leaves[i].margin);
  }
  const int axis = box.longest_side();
  const std::size_t half = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return leaves.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [&](const Node& a, const Node& b) {
    const auto middle = [axis](const Node& n) { return coordinate(n.box.low + n.box.high, axis); };
    const double x = middle(a), y = middle(b);
    return x != y ? x < y : a.light < b.light;
  });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].box = box;
  nodes_[node].margin = margin;
  nodes_[node].first = children;
  nodes_[children].parent = nodes_[children + 1].parent = node;
  build(children, leaves, begin, half);
  build(children + 1, leaves, half, end);
}

// True if the light lies above the horizons of the points' triangles, for points that have such a horizon.
bool OpenLights::is_above(const TilePoints& points, const std::vector<std::uint32_t>& slots, const Node& node) const {
  const Vec3d c = node.box.center(), h = node.box.half();
  return std::all_of(slots.begin(), slots.end(), [&](std::uint32_t i) {
    const shadow::Viewpoint& at = points.points[i];
    if (!at.geometric_normal) return true;
    const Vec3d n = *at.geometric_normal;
    return dot(c - at.position, n) > std::fabs(n.x) * h.x + std::fabs(n.y) * h.y + std::fabs(n.z) * h.z;
  });
}

void OpenLights::find(const TilePoints& points, const std::vector<const PackLight*>& lights, Work& work) const {
  work.open.assign(leaf_of_.size(), 0);
  if (nodes_.empty()) return;
  for (const PackLight* light : lights) work.open[light->index] = leaf_of_[light->index] != kNone;
  std::vector<std::uint32_t> stack;
  for (const std::vector<std::uint32_t>& cluster : points.groups.clusters) {
    work.wanted.assign(nodes_.size(), 0);
    for (const PackLight* light : lights)
      if (work.open[light->index] != 0)
        for (std::uint32_t n = leaf_of_[light->index]; work.wanted[n] == 0; n = nodes_[n].parent) work.wanted[n] = 1;
    std::vector<std::uint32_t> slots;
    for (const std::uint32_t g : cluster) slots.insert(slots.end(), points.groups.groups[g].begin(), points.groups.groups[g].end());
    std::vector<Vec3d> positions;
    positions.reserve(slots.size());
    for (const std::uint32_t i : slots) positions.push_back(points.points[i].position);
    work.viewers.take(positions);
    stack.assign(1, 0);
    while (!stack.empty()) {
      const Node& node = nodes_[stack.back()];
      stack.pop_back();
      if (work.wanted[static_cast<std::size_t>(&node - nodes_.data())] == 0) continue;
      const auto free = [&] {
        if (!is_above(points, slots, node)) return false;
        const shadow::HullOfBoxes hull(work.viewers.box(), node.box);
        return std::none_of(cut_outs_.begin(), cut_outs_.end(), [&](const Box3d& b) { return hull.may_meet(b); }) &&
               triangles_.is_open(work.viewers, node.box, node.margin);
      };
      if (free()) continue;
      if (node.is_leaf)
        work.open[node.light] = 0;
      else
        stack.insert(stack.end(), {node.first, node.first + 1});
    }
  }
}

}  // namespace steradian
