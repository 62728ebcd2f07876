// The scene that frames are timed on: a floor that fills the picture, its materials, and quads above it.
#pragma once

#include "steradian/scene.h"
#include "support/meshes.h"

namespace steradian::bench {

inline constexpr double kFloorHalf = 8;  // half of the floor's side [m]

// The floor covers the whole picture.
inline Scene floor_scene() { return scene::floor_scene({}, static_cast<float>(kFloorHalf), {0, 3, 4}, 0.6); }

inline SurfaceMaterial diffuse() {
  SurfaceMaterial m;
  m.base_color = {0.5f, 0.5f, 0.5f, 1};
  m.metallic = 0;
  m.specular = 0;
  return m;
}

inline SurfaceMaterial glossy() {
  SurfaceMaterial m = diffuse();
  m.specular = 1;
  m.roughness = 0.4f;
  return m;
}

inline AreaLight ceiling_quad(double x, double z, double half) {
  AreaLight light;
  light.shape = Polygon{{{x - half, 1.5, z - half}, {x + half, 1.5, z - half}, {x + half, 1.5, z + half}, {x - half, 1.5, z + half}}, {}};
  light.radiance = {1, 1, 1};
  return light;
}

}  // namespace steradian::bench
