// Intervals and axis-aligned boxes. Both are empty, with low above high, until something is added.
#pragma once

#include <algorithm>
#include <limits>

#include "steradian/vector.h"
#include "steradian/vector2.h"

namespace steradian {

template <class T>
struct Interval {
  T low = std::numeric_limits<T>::infinity(), high = -std::numeric_limits<T>::infinity();

  void add(T x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  T size() const { return high - low; }
  T half() const { return (high - low) / 2; }
  T middle() const { return (low + high) / 2; }
};

template <class T>
constexpr T coordinate(Vector3<T> v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Ties go to the first axis.
template <class T>
constexpr int longest_axis(Vector3<T> size) {
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// V: a vector of two or three coordinates.
template <class V>
struct Box {
  using Number = decltype(V::x);
  static constexpr bool kSolid = requires(V v) { v.z; };
  static constexpr V all(Number x) {
    if constexpr (kSolid)
      return {x, x, x};
    else
      return {x, x};
  }

  V low = all(std::numeric_limits<Number>::infinity()), high = all(-std::numeric_limits<Number>::infinity());

  void add(V p) { add(Box{p, p}); }
  void add(const Box& b) {
    low.x = std::min(low.x, b.low.x);
    low.y = std::min(low.y, b.low.y);
    high.x = std::max(high.x, b.high.x);
    high.y = std::max(high.y, b.high.y);
    if constexpr (kSolid) {
      low.z = std::min(low.z, b.low.z);
      high.z = std::max(high.z, b.high.z);
    }
  }

  bool is_empty() const { return !(low.x <= high.x); }
  V size() const { return high - low; }
  V half() const { return (high - low) * Number(0.5); }
  Number radius() const { return Number(0.5) * length(size()); }  // of the circle or sphere around its corners
  V center() const { return (low + high) * Number(0.5); }
  bool contains(V p) const { return meets({p, p}); }
  bool meets(const Box& b) const {
    bool z = true;
    if constexpr (kSolid) z = low.z <= b.high.z && b.low.z <= high.z;
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && z;
  }
  int longest_side() const { return longest_axis(size()); }
};

using Box2d = Box<Vec2d>;
using Box3d = Box<Vec3d>;
using Box3f = Box<Vec3f>;

}  // namespace steradian
