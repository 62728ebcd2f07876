// Closed boxes, seen from inside.
#pragma once

#include "support/meshes.h"

namespace steradian::scene {

inline SurfaceMaterial grey(float albedo) {
  SurfaceMaterial m;
  m.base_color = {albedo, albedo, albedo, 1};
  m.metallic = 0;
  m.specular = 0;
  return m;
}

// The inner sides of a box of half side 1. With `shining`, each side is a light of radiance 1.
inline Scene closed_box(float albedo, bool shining) {
  Scene scene;
  scene.materials = {grey(albedo)};
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int a = 0; a < 3; ++a)
    for (const double side : {-1.0, 1.0}) {
      const Vec3d n = axes[a] * side, u = axes[(a + 1) % 3] * side, v = axes[(a + 2) % 3];
      const auto corner = [&](double x, double y) { return n + u * x + v * y; };
      const Vec3d corners[4] = {corner(-1, 1), corner(1, 1), corner(1, -1), corner(-1, -1)};
      const auto f = [&](int i) { return static_cast<Vec3f>(corners[i]); };
      scene.meshes.push_back(quad_mesh(f(0), f(1), f(2), f(3), 0));
      if (!shining) continue;
      AreaLight light;
      Polygon polygon;
      polygon.vertices = {corners[0], corners[1], corners[2], corners[3]};
      light.shape = polygon;
      light.radiance = {1, 1, 1};
      scene.area_lights.push_back(light);
    }
  scene.bounds_min = {-1, -1, -1};
  scene.bounds_max = {1, 1, 1};
  scene.cameras = {camera_at({0.1, 0.2, 0.6}, {0.1, -0.3, -1}, 1.2)};
  return scene;
}

}  // namespace steradian::scene
