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

// Area with the sign of agreement between the winding and the stored normals.
inline double signed_area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3f a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]], c = mesh.positions[mesh.indices[i + 2]];
    sum += static_cast<double>(dot(cross(b - a, c - a), mesh.normals[mesh.indices[i]])) / 2;
  }
  return sum;
}

}  // namespace steradian::scene
