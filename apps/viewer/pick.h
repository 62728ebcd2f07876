// What a ray meets first.
#pragma once

#include <cstddef>
#include <optional>

#include "view_camera.h"

namespace steradian::view {

struct Hit {
  std::size_t mesh = 0, triangle = 0;  // into Scene::meshes
  double distance = 0;
  Vec3d point, normal;  // of the triangle, towards the ray's origin
};

// Every triangle is asked: a click can wait for a million of them.
std::optional<Hit> pick(const Scene& scene, const Ray& ray);

}  // namespace steradian::view
