// The first hit of a ray.
#pragma once

#include <cstddef>
#include <optional>

#include "view_camera.h"

namespace steradian::view {

struct Hit {
  std::size_t mesh = 0, triangle = 0;  // indices into Scene::meshes
  double distance = 0;
  Vec3d point, normal;  // the normal is the triangle's, towards the ray's origin
};

// Tests every triangle: a million of them are fast enough for a click.
std::optional<Hit> pick(const Scene& scene, const Ray& ray);

}  // namespace steradian::view
