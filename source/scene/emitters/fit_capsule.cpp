#include "scene/emitters/fit_capsule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/emitters/fit_ellipsoid.h"  // the tolerances
#include "scene/emitters/symmetric_matrix.h"
#include "steradian/capsule_light.h"

namespace steradian::scene {
namespace {

// Measures of a mesh that is symmetric about an axis. They give the axis whatever the triangulation.
struct Surface {
  double area = 0;
  Vec3d center;  // centroid of the area
  Vec3d axis;    // the direction that the fewest faces point to
};

Vec3d twice_area(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

Surface measure(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part) {
  Surface s;
  const Vec3d origin = triangles[part.front()][0];  // avoids cancellation for a part far from the world's origin
  SymmetricMatrix faces(3);
  for (const std::size_t index : part) {
    const Triangle& t = triangles[index];
    const Vec3d n = twice_area(t);
    const double area = length(n) / 2;
    if (!(area > 0)) continue;
    s.area += area;
    s.center += (t[0] + t[1] + t[2] - origin * 3) * (area / 3);
    faces.add_square({n.x, n.y, n.z}, 1 / (4 * area));
  }
  s.center = s.area > 0 ? origin + s.center / s.area : origin;
  const std::vector<double> axis = eigen_system(faces).vectors.front();
  s.axis = {axis[0], axis[1], axis[2]};
  return s;
}

// The largest distance of a corner from its exact place in single precision.
double rounding(Vec3d v) { return 1e-7 * (std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z)); }

}  // namespace

std::optional<Capsule> fit_capsule(const std::vector<Triangle>& triangles, const std::vector<std::size_t>& part) {
  if (part.size() < 64) return {};  // no mesh with fewer faces comes as near as kNearestFace
  const Surface s = measure(triangles, part);
  double radius = 0, reach = 0;
  for (const std::size_t index : part)
    for (const Vec3d& v : triangles[index]) {
      const double along = dot(v - s.center, s.axis);
      reach = std::max(reach, std::fabs(along));
      radius = std::max(radius, length(v - s.center - s.axis * along));
    }
  const double half = reach - radius;
  if (!(half > kOnShape * radius) || !std::isfinite(half)) return {};

  const Capsule around = {s.center - s.axis * half, s.center + s.axis * half, radius};
  for (const std::size_t index : part) {
    const Triangle& t = triangles[index];
    for (const Vec3d& v : t)
      if (!(std::fabs(distance_to_axis(around, v) - radius) <= kOnShape * radius + rounding(v))) return {};
    // Compares the plane of a face with the planes that touch the ends of the axis.
    const Vec3d n = normalized(twice_area(t));
    const double plane = std::fabs(dot(t[0] - s.center, n)) - half * std::fabs(dot(n, s.axis));
    if (length(n) > 0 && !(plane >= kNearestFace * radius - rounding(t[0]))) return {};
  }
  const double share = s.area / (4 * std::numbers::pi * radius * (radius + half));
  if (!(share > 0.9 && share < 1.0001)) return {};  // covered once, not twice

  // Solves 4 pi r (r + half) = area.
  const double of_area = s.area / std::numbers::pi / (2 * (half + std::sqrt(half * half + s.area / std::numbers::pi)));
  return Capsule{around.end_a, around.end_b, of_area};
}

}  // namespace steradian::scene
