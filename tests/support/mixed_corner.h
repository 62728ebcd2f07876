// Scenes and sums for tests of the bounce: a floor and a wall under a spot light.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "steradian/compare.h"
#include "steradian/render.h"
#include "support/meshes.h"

namespace steradian::indirect {

inline SurfaceMaterial metal(float roughness) {
  SurfaceMaterial m;
  m.base_color = {1, 1, 1, 1};
  m.metallic = 1;
  m.roughness = roughness;
  return m;
}
inline SurfaceMaterial plastic(float albedo, float roughness) {
  SurfaceMaterial m;
  m.base_color = {albedo, 0.8f * albedo, 0.6f * albedo, 1};
  m.metallic = 0;
  m.roughness = roughness;
  return m;
}

// A floor (material 0) that meets a wall (material 1), and a spot light on the wall. Nothing occludes the bounce.
inline Scene corner(SurfaceMaterial floor, SurfaceMaterial wall) {
  Scene scene;
  scene.materials = {floor, wall};
  scene.meshes = {scene::quad_mesh({-2, 0, 3}, {2, 0, 3}, {2, 0, 0}, {-2, 0, 0}, 0),
                  scene::quad_mesh({-2, 0, 0}, {2, 0, 0}, {2, 3, 0}, {-2, 3, 0}, 1)};
  scene.bounds_min = {-2, 0, 0};
  scene.bounds_max = {2, 3, 3};
  PunctualLight light;
  light.kind = PunctualKind::spot;
  light.position = {0.3, 1.8, 2.5};
  light.direction = normalized(Vec3d{0, 1.1, 0} - light.position);
  light.intensity = {10, 9, 8};
  light.cos_inner = std::cos(0.2);
  light.cos_outer = std::cos(0.35);
  scene.punctual_lights = {light};
  scene.cameras = {scene::camera_at({0.6, 1.6, 4.5}, {-0.6, -1, -3.7}, 0.8)};
  return scene;
}

inline Scene metal_corner(float roughness = 0.4f) { return corner(metal(roughness), metal(0.5f)); }
inline Scene mixed_corner() { return corner(plastic(0.6f, 0.45f), plastic(0.7f, 0.5f)); }

// A mirror-like, tilted sheet, lit from both sides. Neither side sends light to the other.
inline Scene lit_sheet() {
  Scene scene = corner(metal(0.2f), metal(0.2f));
  scene.materials[0].double_sided = true;
  const Vec3f x{1.7f, 0.31f, -0.23f}, y{0.14f, 1.31f, 0.77f};
  scene.meshes = {scene::quad_mesh(x * -1.0f - y, x - y, x + y, y - x, 0)};
  scene.bounds_min = {-2, -2, -2};
  scene.bounds_max = {2, 2, 2};
  scene.punctual_lights[0].kind = PunctualKind::point;
  scene.punctual_lights[0].position = {0.2, -0.3, 1.2};
  scene.punctual_lights.push_back(scene.punctual_lights[0]);
  scene.punctual_lights[1].position = {-0.1, 0.2, -1.1};
  scene.cameras = {scene::camera_at({0.6, 1.1, 3.5}, {-0.6, -1.1, -3.5}, 0.8)};
  return scene;
}

inline float largest(const std::vector<Vec3f>& pixels) {
  float most = 0;
  for (const Vec3f& c : pixels) most = std::max({most, c.x, c.y, c.z});
  return most;
}

inline RenderOptions options(IndirectMode mode, int lights) {
  RenderOptions o;
  o.width = 48;
  o.height = 36;
  o.method = "closed-form";
  o.shadows = Shadows::off;
  o.indirect.mode = mode;
  o.indirect.virtual_lights = lights;
  return o;
}

// The indirect light alone.
inline Picture bounce(const Scene& scene, const RenderOptions& o) {
  const Picture all = render(scene, o);
  Picture result(all.width, all.height);
  result.pixels = all.layers.at("indirect");
  return result;
}

inline Picture plain_sum(const Scene& scene, IndirectMode mode, int lights) {
  RenderOptions o = options(mode, lights);
  o.indirect.kept_pairs = 0;
  o.indirect.interleave = 1;
  o.indirect.quads = o.indirect.soften = false;
  return bounce(scene, o);
}

// R0 and R1: the sum over every virtual light at every pixel, in double.
inline Picture true_sum(const Scene& scene, IndirectMode mode, int lights) {
  RenderOptions o = options(mode, lights);
  o.method = "reference";
  o.target_error = 1;  // for the direct light, which the tests ignore
  return bounce(scene, o);
}

inline double mean(const Picture& p) {
  double sum = 0;
  for (const Vec3f& c : p.pixels) sum += c.x + c.y + c.z;
  return sum / (3.0 * static_cast<double>(p.pixels.size()));
}

}  // namespace steradian::indirect
