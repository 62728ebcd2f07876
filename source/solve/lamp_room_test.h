// A room with one lamp, for tests of fits.
#pragma once

#include "steradian/render.h"
#include "steradian/solve.h"
#include "support/boxes.h"

namespace steradian::solve_test {

// A rectangle with its lit side towards -y, turned about x and z.
inline AreaLight panel(Vec3d center, double width, double height, Vec3d radiance, Vec3d turn = {}) {
  const auto turned = [&](Vec3d v) { return rotated(rotated(v, {1, 0, 0}, turn.x), {0, 0, 1}, turn.z); };
  const Vec3d x = turned({width / 2, 0, 0}), y = turned({0, 0, height / 2});
  Polygon polygon;
  polygon.vertices = {center - x - y, center + x - y, center + x + y, center - x + y};
  AreaLight light;
  light.shape = polygon;
  light.radiance = radiance;
  light.name = "lamp";
  light.power = luminance(radiance) * width * height;
  return light;
}

// A room of 6 x 3 x 6 m without a front wall: a glossy floor, three diffuse walls and a ceiling.
inline Scene room() {
  Scene scene;
  SurfaceMaterial glossy = scene::grey(0.5f);
  glossy.specular = 1;
  glossy.roughness = 0.5f;
  scene.materials = {scene::grey(0.6f), glossy};
  const auto add = [&](Vec3f a, Vec3f b, Vec3f c, Vec3f d, int material) {
    scene.meshes.push_back(scene::quad_mesh(a, b, c, d, material));
  };
  add({-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, 1);
  add({-3, 0, -3}, {3, 0, -3}, {3, 3, -3}, {-3, 3, -3}, 0);
  add({-3, 0, 3}, {-3, 0, -3}, {-3, 3, -3}, {-3, 3, 3}, 0);
  add({3, 0, -3}, {3, 0, 3}, {3, 3, 3}, {3, 3, -3}, 0);
  add({-3, 3, -3}, {3, 3, -3}, {3, 3, 3}, {-3, 3, 3}, 0);
  scene.bounds_min = {-3, 0, -3};
  scene.bounds_max = {3, 3, 3};
  scene.cameras = {scene::camera_at({0, 1.5, 6}, {0, -0.1, -1}, 0.8)};
  return scene;
}

inline PictureTarget picture_of(const Scene& scene, int width, int height) {
  RenderOptions options;
  options.width = width;
  options.height = height;
  PictureTarget target;
  target.picture = render(scene, options);
  return target;
}

inline const Polygon& polygon_of(const AreaLight& light) { return std::get<Polygon>(light.shape); }
inline Vec3d center_of(const AreaLight& light) {
  const auto& v = polygon_of(light).vertices;
  return (v[0] + v[1] + v[2] + v[3]) * 0.25;
}

inline LightFit everything(std::size_t light) {
  LightFit fit;
  fit.light = light;
  fit.power = fit.position = fit.rotation = fit.size = true;
  fit.position_x = {-2.5, 2.5};
  fit.position_y = {1.5, 2.9};
  fit.position_z = {-2.5, 2.5};
  fit.most_degrees = 60;
  fit.size_range = {0.1, 3};
  return fit;
}

}  // namespace steradian::solve_test
