// A floor that fills the picture, its materials, and quads above it: what frames are timed on.
#pragma once

#include "steradian/scene.h"

namespace steradian::bench {

inline constexpr double kFloorHalf = 8;  // of the floor's side [m]

// A floor seen at an angle; it covers the whole picture.
inline Scene floor_scene() {
  Scene scene;
  scene.materials.resize(1);
  Mesh mesh;
  constexpr auto kEnd = static_cast<float>(kFloorHalf);
  mesh.positions = {{-kEnd, 0, kEnd}, {kEnd, 0, kEnd}, {kEnd, 0, -kEnd}, {-kEnd, 0, -kEnd}};
  mesh.normals.assign(4, {0, 1, 0});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.meshes = {mesh};
  Camera camera;
  camera.position = {0, 3, 4};
  camera.z = normalized(Vec3d{0, 3, 4});
  camera.y = cross(camera.z, camera.x);
  camera.yfov = 0.6;
  scene.cameras = {camera};
  return scene;
}

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
