// Axis-aligned boxes, from which trees over triangles and lights are built.
#pragma once

#include <algorithm>
#include <cmath>

#include "steradian/vector.h"

namespace steradian::shadow {

inline double coordinate(Vec3d v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Box {
  Vec3d low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  void add(Vec3d p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void add(const Box& b) {
    add(b.low);
    add(b.high);
  }
};

// The axis along which a box is longest.
inline int longest_side(const Box& b) {
  const Vec3d size = b.high - b.low;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

}  // namespace steradian::shadow
