#include "device/shadow/ray_hierarchy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "render/surface/ray_scene.h"
#include "core/box.h"

namespace steradian::vulkan {
namespace {

#include "shaders/ray_layout.glsl"

constexpr std::size_t kLeaf = 4;  // most triangles
static_assert(kLeaf < static_cast<std::size_t>(kLeafSizes));
constexpr auto kFirst = static_cast<std::size_t>(kHead);  // first vector of the nodes
constexpr int kBins = 16;
constexpr double kCostOfTriangle = 1.5;  // relative to that of a box

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double half_area(const Box3d& b) {
  const Vec3d d = b.size();
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

class Builder {
 public:
  explicit Builder(const std::vector<RayTriangle>& triangles) {
    float size = 0;
    for (const RayTriangle& t : triangles)
      for (const Vec3d& v : t.corners)
        size = std::max(size, static_cast<float>(std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)})));
    unit_ = unit_of_size(size);
    for (const RayTriangle& t : triangles) {
      Triangle triangle{t, {}, {}};
      for (Vec3d& corner : triangle.of.corners) triangle.box.add(corner = corner * static_cast<double>(unit_));
      triangle.middle = triangle.box.center();
      all_.add(triangle.box);
      triangles_.push_back(triangle);
    }
    // Positions relative to a ray's origin have errors of some roundings of their distance.
    const Vec3d across = triangles_.empty() ? Vec3d{} : all_.size();
    margin_ = 0x1p-20 * std::max({across.x, across.y, across.z});
    build(0, triangles_.size());
  }

  std::vector<std::array<std::uint32_t, 4>> vectors() {
    const std::size_t nodes = vectors_.size() / 2;
    for (std::size_t n = 0; n < nodes; ++n) {
      std::uint32_t& leaf = vectors_[2 * n][3];
      if (leaf != 0) leaf += static_cast<std::uint32_t>((kFirst + 2 * nodes) * static_cast<std::size_t>(kLeafSizes));
    }
    vectors_.insert(vectors_.begin(), {std::bit_cast<std::uint32_t>(unit_), 0, 0, 0});
    for (const Triangle& t : triangles_)
      for (const Vec3d& v : t.of.corners) vectors_.push_back(vector(v, t.of.number));
    return std::move(vectors_);
  }

 private:
  struct Triangle {
    RayTriangle of;
    Box3d box;
    Vec3d middle;
  };
  struct Split {
    double cost = kInfinity;  // in half areas
    int axis = 0;
    double at = 0;
  };

  static std::uint32_t bits(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }
  static std::array<std::uint32_t, 4> vector(Vec3d v, std::uint32_t w) { return {bits(v.x), bits(v.y), bits(v.z), w}; }

  // Finds the plane between two bins along an axis that separates the triangles' middles best, by the boxes' areas and numbers of
  // triangles. I. Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007.
  void try_axis(std::size_t begin, std::size_t end, const Box3d& middles, int axis, Split& best) const {
    const double low = coordinate(middles.low, axis), width = (coordinate(middles.high, axis) - low) / kBins;
    if (!(width > 0)) return;
    std::array<Box3d, kBins> boxes;
    std::array<std::size_t, kBins> counts{};
    for (std::size_t i = begin; i < end; ++i) {
      const auto bin = static_cast<std::size_t>(std::clamp((coordinate(triangles_[i].middle, axis) - low) / width, 0.0, kBins - 1.0));
      boxes[bin].add(triangles_[i].box);
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

  void build(std::size_t begin, std::size_t end) {
    Box3d box, middles;
    for (std::size_t i = begin; i < end; ++i) {
      box.add(triangles_[i].box);
      middles.add(triangles_[i].middle);
    }
    const std::size_t node = vectors_.size(), count = end - begin;
    const Vec3d grow{margin_, margin_, margin_};
    vectors_.push_back(vector(box.low - grow, 0));
    vectors_.push_back(vector(box.high + grow, 0));
    Split split;
    for (int axis = 0; axis < 3; ++axis) try_axis(begin, end, middles, axis, split);
    const bool whole = count <= kLeaf &&
                       !(2 * half_area(box) + kCostOfTriangle * split.cost < kCostOfTriangle * static_cast<double>(count) * half_area(box));
    if (whole) {
      // Counted from the first triangle, until the number of nodes is known.
      vectors_[node][3] = static_cast<std::uint32_t>(3 * begin * static_cast<std::size_t>(kLeafSizes) + count);
    } else {
      const auto first = triangles_.begin();
      const auto at = [&](std::size_t i) { return first + static_cast<std::ptrdiff_t>(i); };
      auto middle = std::partition(at(begin), at(end), [&](const Triangle& t) { return coordinate(t.middle, split.axis) < split.at; });
      // Any half will do for triangles at one place, and if roundings leave a side empty.
      if (!(split.cost < kInfinity) || middle == at(begin) || middle == at(end)) middle = at(begin + count / 2);
      const auto half = static_cast<std::size_t>(middle - first);
      build(begin, half);
      build(half, end);
    }
    vectors_[node + 1][3] = static_cast<std::uint32_t>(vectors_.size() / 2);
  }

  Box3d all_;
  float unit_ = 1;
  double margin_ = 0;
  std::vector<Triangle> triangles_;
  std::vector<std::array<std::uint32_t, 4>> vectors_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 4>> ray_hierarchy(const std::vector<RayTriangle>& triangles) { return Builder(triangles).vectors(); }

std::size_t least_of_hierarchy(std::size_t triangles) {
  const std::size_t leaves = std::max<std::size_t>((triangles + kLeaf - 1) / kLeaf, 1);
  return kFirst + 3 * triangles + 2 * (2 * leaves - 1);
}

}  // namespace steradian::vulkan
