// Meshes, cameras and floors for the scenes of tests and benches.
#pragma once

#include <cmath>
#include <numbers>

#include "steradian/scene.h"

namespace steradian::scene {

// The corners run counter-clockwise as seen from the side of the normal.
inline Mesh quad_mesh(Vec3f a, Vec3f b, Vec3f c, Vec3f d, int material) {
  Mesh mesh;
  mesh.material = material;
  mesh.positions = {a, b, c, d};
  const Vec3f n = normalized(cross(b - a, c - a));
  mesh.normals = {n, n, n, n};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

// The area, negative where the winding disagrees with the stored normals.
inline double signed_area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3f a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]], c = mesh.positions[mesh.indices[i + 2]];
    sum += static_cast<double>(dot(cross(b - a, c - a), mesh.normals[mesh.indices[i]])) / 2;
  }
  return sum;
}

// A faceted ball with smooth normals: the shading and the geometric horizon differ.
inline Mesh ball_mesh(Vec3f center, float radius, int material, unsigned columns, unsigned rows) {
  Mesh mesh;
  mesh.material = material;
  const auto share = [](unsigned i, unsigned count) {
    return std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(count);
  };
  for (unsigned j = 0; j <= rows; ++j)
    for (unsigned i = 0; i <= columns; ++i) {
      const float u = 2 * share(i % columns, columns), v = share(j, rows);
      const float s = j == 0 || j == rows ? 0.0f : std::sin(v);
      const Vec3f n{s * std::cos(u), std::cos(v), -s * std::sin(u)};
      mesh.positions.push_back(center + n * radius);
      mesh.normals.push_back(n);
    }
  for (unsigned j = 0; j < rows; ++j)
    for (unsigned i = 0; i < columns; ++i) {
      const unsigned a = j * (columns + 1) + i, b = a + columns + 1;
      for (const unsigned v : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(v);
    }
  return mesh;
}

// A camera at a place that looks along +direction+, with the top of its picture towards y.
inline Camera camera_at(Vec3d position, Vec3d direction, double yfov = Camera{}.yfov) {
  Camera camera;
  camera.position = position;
  camera.z = -normalized(direction);
  camera.x = normalized(cross(Vec3d{0, 1, 0}, camera.z));
  camera.y = cross(camera.z, camera.x);
  camera.yfov = yfov;
  return camera;
}

// A square floor of one material at y = 0, and a camera above that looks at its middle. The scene has no light.
inline Scene floor_scene(const SurfaceMaterial& material, float half, Vec3d eye, double yfov = Camera{}.yfov) {
  Scene scene;
  scene.materials = {material};
  scene.meshes = {quad_mesh({-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}, 0)};
  scene.cameras = {camera_at(eye, -eye, yfov)};
  return scene;
}

}  // namespace steradian::scene
