#include "pick.h"

#include <cmath>

namespace steradian::view {

// Intersects a ray with the scene's triangles. Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
std::optional<Hit> pick(const Scene& scene, const Ray& ray) {
  std::optional<Hit> nearest;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const auto corner = [&](std::size_t c) { return static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]); };
      const Vec3d a = corner(0), e1 = corner(1) - a, e2 = corner(2) - a, p = cross(ray.direction, e2);
      const double det = dot(e1, p);
      if (det == 0) continue;
      const Vec3d s = ray.origin - a, q = cross(s, e1);
      const double u = dot(s, p) / det, v = dot(ray.direction, q) / det, distance = dot(e2, q) / det;
      if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0) || (nearest && distance >= nearest->distance)) continue;
      const Vec3d n = normalized(cross(e1, e2));
      nearest = Hit{m, t, distance, ray.origin + ray.direction * distance, dot(n, ray.direction) > 0 ? -n : n};
    }
  }
  return nearest;
}

}  // namespace steradian::view
