// Closed rings of triangles for tests: meshes that are not convex and lie before themselves.
#pragma once

#include <cmath>
#include <numbers>

#include "steradian/scene.h"

namespace steradian::scene {

// A torus about z, turned about x by a tilt. Its facets are flat.
inline Mesh ring_mesh(Vec3d center, double radius, double thickness, double tilt, int material, unsigned columns, unsigned rows) {
  Mesh mesh;
  mesh.material = material;
  const auto at = [&](unsigned i, unsigned j) {
    const double u = 2 * std::numbers::pi * (i % columns) / columns, v = 2 * std::numbers::pi * (j % rows) / rows;
    const double r = radius + thickness * std::cos(v), y = r * std::sin(u), z = thickness * std::sin(v);
    return static_cast<Vec3f>(center +
                              Vec3d{r * std::cos(u), y * std::cos(tilt) - z * std::sin(tilt), y * std::sin(tilt) + z * std::cos(tilt)});
  };
  const auto add = [&](Vec3f a, Vec3f b, Vec3f c) {
    for (const Vec3f& p : {a, b, c}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(p);
      mesh.normals.push_back(normalized(cross(b - a, c - a)));
    }
  };
  for (unsigned i = 0; i < columns; ++i)
    for (unsigned j = 0; j < rows; ++j) {
      const Vec3f a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      add(a, b, c);
      add(a, c, d);
    }
  return mesh;
}

}  // namespace steradian::scene
