// Flat arrays of vectors: what every pass of the indirect light reads and writes.
#pragma once

#include <cstddef>
#include <vector>

#include "steradian/vector.h"

namespace steradian::indirect {

struct VectorArray {
  std::vector<float> x, y, z;

  VectorArray() = default;
  explicit VectorArray(std::size_t size) : x(size), y(size), z(size) {}
  std::size_t size() const { return x.size(); }
  void resize(std::size_t size) {
    x.resize(size);
    y.resize(size);
    z.resize(size);
  }
  Vec3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void put(std::size_t i, Vec3f v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

inline float largest(Vec3f v) { return v.x > v.y ? (v.x > v.z ? v.x : v.z) : (v.y > v.z ? v.y : v.z); }

}  // namespace steradian::indirect
