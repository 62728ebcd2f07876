// Overlaps: triangles of a plane, and the question of whether another one overlaps them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/box.h"
#include "steradian/vector2.h"

namespace steradian::bake {

class Overlaps {
 public:
  // size: about that of the triangles.
  explicit Overlaps(double size) : cell_(size > 0 ? size : 1) {}

  void add(const std::array<Vec2d, 3>& triangle) {
    const auto number = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(triangle);
    if (is_large(triangle)) return large_.push_back(number);
    any_cell(triangle, [&](std::uint64_t key) {
      cells_[key].push_back(number);
      return false;
    });
  }

  // True if the insides of a triangle and of one that was added meet. Those that share an edge or a corner do not.
  bool meet(const std::array<Vec2d, 3>& triangle) const {
    const auto overlaps = [&](std::uint32_t k) { return !parted(triangle, triangles_[k]) && !parted(triangles_[k], triangle); };
    if (is_large(triangle)) {
      for (std::uint32_t k = 0; k < triangles_.size(); ++k)
        if (overlaps(k)) return true;
      return false;
    }
    return std::any_of(large_.begin(), large_.end(), overlaps) || any_cell(triangle, [&](std::uint64_t key) {
             const auto found = cells_.find(key);
             return found != cells_.end() && std::any_of(found->second.begin(), found->second.end(), overlaps);
           });
  }

 private:
  static constexpr std::int64_t kMostCells = 256;  // along a side of a triangle's box; larger ones are in no cell
  static constexpr double kTouch = 1e-6;           // depth of contact in cells, the rounding of single precision

  // True if an edge of `a` has all of `b` on its outer side.
  bool parted(const std::array<Vec2d, 3>& a, const std::array<Vec2d, 3>& b) const {
    const double turn = cross(a[1] - a[0], a[2] - a[0]) < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2d edge = a[(k + 1) % 3] - a[k];
      const double l = length(edge);
      if (!(l > 0)) return true;
      double deepest = -1e300;
      for (const Vec2d p : b) deepest = std::max(deepest, turn * cross(edge, p - a[k]) / l);
      if (deepest <= kTouch * std::max(cell_, l)) return true;
    }
    return false;
  }

  std::int64_t index(double x) const { return static_cast<std::int64_t>(std::clamp(std::floor(x / cell_), -1e9, 1e9)); }
  static Box2d box_of(const std::array<Vec2d, 3>& triangle) {
    Box2d box;
    for (const Vec2d p : triangle) box.add(p);
    return box;
  }
  bool is_large(const std::array<Vec2d, 3>& triangle) const {
    const Box2d box = box_of(triangle);
    return index(box.high.x) - index(box.low.x) > kMostCells || index(box.high.y) - index(box.low.y) > kMostCells;
  }

  template <class Use>  // use(key) returns true to end
  bool any_cell(const std::array<Vec2d, 3>& triangle, Use use) const {
    const Box2d box = box_of(triangle);
    for (std::int64_t y = index(box.low.y); y <= index(box.high.y); ++y)
      for (std::int64_t x = index(box.low.x); x <= index(box.high.x); ++x)
        if (use(static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^ static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu)) return true;
    return false;
  }

  const double cell_;
  std::vector<std::array<Vec2d, 3>> triangles_;
  std::vector<std::uint32_t> large_;  // numbers of triangles over many cells
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace steradian::bake
