// Meshes that tests put their scenes together from.
#pragma once

#include "steradian/scene.h"

namespace steradian::scene {

// Corners counter-clockwise as seen from the side of the normal.
inline Mesh quad_mesh(Vec3f a, Vec3f b, Vec3f c, Vec3f d, int material) {
  Mesh mesh;
  mesh.material = material;
  mesh.positions = {a, b, c, d};
  const Vec3f n = normalized(cross(b - a, c - a));
  mesh.normals = {n, n, n, n};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

}  // namespace steradian::scene
