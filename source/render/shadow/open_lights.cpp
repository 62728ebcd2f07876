#include "render/shadow/open_lights.h"

#include <algorithm>
#include <cmath>

#include "core/box.h"

namespace steradian {
namespace {

bool has_place(const PackLight& light) {
  if (light.is_pieces()) return false;
  const auto* punctual = std::get_if<packed::Punctual>(&light.shape);
  return punctual == nullptr || punctual->kind != PunctualKind::directional;
}

}  // namespace

OpenLights::OpenLights(const std::vector<PackLight>& lights, const shadow::TriangleTree& triangles, const std::vector<Box3d>& cut_outs)
    : count_(lights.size()), triangles_(triangles), cut_outs_(cut_outs) {
  std::vector<Volume> volumes;
  for (const PackLight& light : lights) {
    if (!has_place(light)) continue;
    Volume volume;
    volume.margin = light.is_polygon() ? shadow::margin_of_plane(light.polygon) : 0;
    if (light.is_polygon()) {
      for (const Vec3d& v : light.polygon.vertices) volume.Box3d::add(v);
    } else {
      std::visit(
          [&](const auto& shape) {
            shape.any_bound([&](Vec3f p, float r) {
              const auto c = static_cast<Vec3d>(p), d = Box3d::all(static_cast<double>(r) * (1 + 1e-6));
              volume.Box3d::add({c - d, c + d});
              return false;
            });
          },
          light.shape);
    }
    volumes.push_back(volume);
    lights_.push_back(static_cast<std::uint32_t>(light.index));
  }
  const auto halves = [&](std::span<BoxTree<Volume>::Item> items) -> std::size_t {
    if (items.size() <= 1) return 0;
    Volume all;
    for (const auto& item : items) all.add(volumes[item.number]);
    return halve(items, items.size() / 2, all.longest_side());
  };
  tree_ = BoxTree<Volume>(
      volumes.size(), [&](std::uint32_t i) { return volumes[i]; }, halves);
}

// True if the lights lie above the horizons of the points' triangles, for points that have such a horizon.
bool OpenLights::is_above(const TilePoints& points, const std::vector<std::uint32_t>& slots, const Box3d& lights) const {
  const Vec3d c = lights.center(), h = lights.half();
  return std::all_of(slots.begin(), slots.end(), [&](std::uint32_t i) {
    const shadow::Viewpoint& at = points.points[i];
    if (!at.geometric_normal) return true;
    const Vec3d n = *at.geometric_normal;
    return dot(c - at.position, n) > std::fabs(n.x) * h.x + std::fabs(n.y) * h.y + std::fabs(n.z) * h.z;
  });
}

void OpenLights::find(const TilePoints& points, const std::vector<const PackLight*>& lights, Work& work) const {
  work.open.assign(count_, 0);
  for (const PackLight* light : lights) work.open[light->index] = has_place(*light);
  for (const std::vector<std::uint32_t>& cluster : points.groups.clusters) {
    std::vector<std::uint32_t> slots;
    for (const std::uint32_t g : cluster) slots.insert(slots.end(), points.groups.groups[g].begin(), points.groups.groups[g].end());
    std::vector<Vec3d> positions;
    positions.reserve(slots.size());
    for (const std::uint32_t i : slots) positions.push_back(points.points[i].position);
    work.viewers.take(positions);
    const auto occluded = [&](const BoxTree<Volume>::Node& node) {
      const std::span<const std::uint32_t> below = tree_.items(node);
      if (std::none_of(below.begin(), below.end(), [&](std::uint32_t i) { return work.open[lights_[i]] != 0; })) return false;
      if (!is_above(points, slots, node.volume)) return true;
      const shadow::HullOfBoxes hull(work.viewers.box(), node.volume);
      return std::any_of(cut_outs_.begin(), cut_outs_.end(), [&](const Box3d& b) { return hull.may_meet(b); }) ||
             !triangles_.is_open(work.viewers, node.volume, node.volume.margin);
    };
    tree_.any_leaf(occluded, [&](std::uint32_t first, std::uint32_t) {
      work.open[lights_[tree_.order()[first]]] = 0;
      return false;
    });
  }
}

}  // namespace steradian
