#include "device/shadow/ray_hierarchy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "core/box_tree.h"
#include "render/surface/ray_scene.h"

namespace steradian::vulkan {
namespace {

#include "shaders/shadow/ray_layout.glsl"

constexpr std::size_t kLeaf = 4;  // most triangles
static_assert(kLeaf < static_cast<std::size_t>(kLeafSizes));
constexpr auto kFirst = static_cast<std::size_t>(kHead);  // first vector of the nodes
constexpr int kBins = 16;
constexpr double kCostOfTriangle = 1.5;  // relative to that of a box

using Item = BoxTree<Box3d>::Item;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double half_area(const Box3d& b) {
  const Vec3d d = b.size();
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

std::uint32_t bits(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }
std::array<std::uint32_t, 4> vector(Vec3d v, std::uint32_t w) { return {bits(v.x), bits(v.y), bits(v.z), w}; }

// Splits triangles at the plane between two bins along an axis that separates their middles best, by the boxes' areas and numbers of
// triangles. I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007.
class AreaSplit {
 public:
  explicit AreaSplit(const std::vector<Box3d>& boxes) : boxes_(boxes) {}

  std::size_t operator()(std::span<Item> items) const {
    Box3d box, middles;
    for (const Item& item : items) {
      box.add(boxes_[item.number]);
      middles.add(item.middle);
    }
    Plane plane;
    for (int axis = 0; axis < 3; ++axis) try_axis(items, middles, axis, plane);
    const std::size_t count = items.size();
    const bool whole = count <= kLeaf &&
                       !(2 * half_area(box) + kCostOfTriangle * plane.cost < kCostOfTriangle * static_cast<double>(count) * half_area(box));
    if (whole) return 0;
    const auto middle =
        std::partition(items.begin(), items.end(), [&](const Item& item) { return coordinate(item.middle, plane.axis) < plane.at; });
    // Any half will do for triangles at one place, and if roundings leave a side empty.
    if (!(plane.cost < kInfinity) || middle == items.begin() || middle == items.end()) return count / 2;
    return static_cast<std::size_t>(middle - items.begin());
  }

 private:
  struct Plane {
    double cost = kInfinity;  // in half areas
    int axis = 0;
    double at = 0;
  };

  void try_axis(std::span<const Item> items, const Box3d& middles, int axis, Plane& best) const {
    const double low = coordinate(middles.low, axis), width = (coordinate(middles.high, axis) - low) / kBins;
    if (!(width > 0)) return;
    std::array<Box3d, kBins> boxes;
    std::array<std::size_t, kBins> counts{};
    for (const Item& item : items) {
      const auto bin = static_cast<std::size_t>(std::clamp((coordinate(item.middle, axis) - low) / width, 0.0, kBins - 1.0));
      boxes[bin].add(boxes_[item.number]);
      ++counts[bin];
    }
    if (std::find(counts.begin(), counts.end(), 0) != counts.end()) return;  // an axis with an empty bin is not used
    std::array<double, kBins> above{};
    Box3d box;
    std::size_t count = 0;
    for (std::size_t b = kBins - 1; b > 0; --b) {
      box.add(boxes[b]);
      count += counts[b];
      above[b] = count > 0 ? half_area(box) * static_cast<double>(count) : kInfinity;
    }
    box = {};
    count = 0;
    for (std::size_t b = 1; b < kBins; ++b) {
      box.add(boxes[b - 1]);
      count += counts[b - 1];
      const double cost = count > 0 ? half_area(box) * static_cast<double>(count) + above[b] : kInfinity;
      if (cost < best.cost) best = {cost, axis, low + width * static_cast<double>(b)};
    }
  }

  const std::vector<Box3d>& boxes_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 4>> ray_hierarchy(std::vector<RayTriangle> triangles) {
  float size = 0;
  for (const RayTriangle& t : triangles)
    for (const Vec3d& v : t.corners) size = std::max(size, static_cast<float>(std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)})));
  const float unit = unit_of_size(size);
  std::vector<Box3d> boxes(triangles.size());
  Box3d all;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (Vec3d& corner : triangles[i].corners) boxes[i].add(corner = corner * static_cast<double>(unit));
    all.add(boxes[i]);
  }
  const BoxTree<Box3d> tree(
      triangles.size(), [&](std::uint32_t i) { return boxes[i]; }, AreaSplit(boxes));

  // Positions relative to a ray's origin have errors of some roundings of their distance.
  const double margin = triangles.empty() ? 0 : 0x1p-20 * coordinate(all.size(), all.longest_side());
  std::vector<std::array<std::uint32_t, 4>> vectors = {{std::bit_cast<std::uint32_t>(unit), 0, 0, 0}};
  const std::size_t count = tree.nodes().size() - 1;
  for (std::uint32_t n = 0; n < count; ++n) {
    const BoxTree<Box3d>::Node& node = tree.nodes()[n];
    const std::size_t place = (kFirst + 2 * count + 3 * node.first) * static_cast<std::size_t>(kLeafSizes) + tree.items(node).size();
    vectors.push_back(vector(node.volume.low - Box3d::all(margin), node.next == n + 1 ? static_cast<std::uint32_t>(place) : 0));
    vectors.push_back(vector(node.volume.high + Box3d::all(margin), node.next));
  }
  for (const std::uint32_t i : tree.order())
    for (const Vec3d& v : triangles[i].corners) vectors.push_back(vector(v, triangles[i].number));
  return vectors;
}

std::size_t least_of_hierarchy(std::size_t triangles) {
  const std::size_t leaves = std::max<std::size_t>((triangles + kLeaf - 1) / kLeaf, 1);
  return kFirst + 3 * triangles + 2 * (2 * leaves - 1);
}

}  // namespace steradian::vulkan
