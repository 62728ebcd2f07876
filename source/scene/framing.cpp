#include "scene/framing.h"

#include <algorithm>
#include <cmath>

namespace steradian {
namespace {

struct Sphere {
  Vec3d center;
  double radius = 1;
};

Sphere bounding_sphere(const Scene& scene) {
  const double radius = length(scene.bounds_max - scene.bounds_min) / 2;
  // A scene of one point or of nothing is still looked at from a distance.
  return {(scene.bounds_min + scene.bounds_max) * 0.5, radius > 0 ? radius : 1};
}

}  // namespace

void measure_bounds(Scene& scene) {
  bool any = false;
  for (const Mesh& mesh : scene.meshes)
    for (const Vec3f& p : mesh.positions) {
      const Vec3d v = static_cast<Vec3d>(p);
      if (!any) scene.bounds_min = scene.bounds_max = v;
      any = true;
      scene.bounds_min = {std::min(scene.bounds_min.x, v.x), std::min(scene.bounds_min.y, v.y),
                          std::min(scene.bounds_min.z, v.z)};
      scene.bounds_max = {std::max(scene.bounds_max.x, v.x), std::max(scene.bounds_max.y, v.y),
                          std::max(scene.bounds_max.z, v.z)};
    }
}

Camera framing_camera(const Scene& scene) {
  const Sphere sphere = bounding_sphere(scene);
  Camera camera;
  camera.name = "default";
  camera.z = normalized(Vec3d{0, 0.4, 1});
  camera.x = {1, 0, 0};
  camera.y = cross(camera.z, camera.x);
  camera.position = sphere.center + camera.z * (1.05 * sphere.radius / std::sin(camera.yfov / 2));
  return camera;
}

AreaLight default_light(const Scene& scene) {
  const Sphere sphere = bounding_sphere(scene);
  const double r = sphere.radius;
  const Vec3d towards_light = normalized(Vec3d{-0.4, 0.8, 0.6});
  const Frame frame = Frame::from_normal(-towards_light);
  AreaLight light;
  light.name = "default";
  light.center = sphere.center + towards_light * (3 * r);
  const Vec3d x = frame.x * r, y = frame.y * r;
  light.polygon.vertices = {light.center - x - y, light.center + x - y, light.center + x + y,
                            light.center - x + y};
  // Irradiance about pi where the scene's centre faces the light: radiance (2r)^2 / (3r)^2 = pi.
  const double radiance = 3.14159265358979324 * 9 / 4;
  light.polygon.radiance = {radiance, radiance, radiance};
  light.power = luminance(light.polygon.radiance) * 4 * r * r;
  return light;
}

}  // namespace steradian
