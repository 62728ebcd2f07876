// Affine maps of space: three columns and a translation.
#pragma once

#include "steradian/vector.h"

namespace steradian::scene {

struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t{0, 0, 0};

  Vec3d vector(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(Vec3d p) const { return vector(p) + t; }
  double determinant() const { return dot(cross(x, y), z); }
  // Transforms a normal by the cofactors. They are the inverse transpose times the determinant, with the determinant's sign taken out.
  Vec3d normal(Vec3d n) const {
    const Vec3d v = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return normalized(determinant() < 0 ? -v : v);
  }
  bool operator==(const Affine&) const = default;
  friend Affine operator*(const Affine& a, const Affine& b) { return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.t)}; }
};

}  // namespace steradian::scene
