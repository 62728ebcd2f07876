#include "scene/emitters/light_face.h"

#include <algorithm>
#include <cmath>

namespace steradian::scene {

float roundings_of_plane(const AreaLight& light) {
  if (!light.is_flat()) return 0;
  const PolygonLight polygon = flat_polygon(light, 8);
  double largest = 0;
  Vec3d low = polygon.vertices.front(), high = low;
  for (const Vec3d& v : polygon.vertices) {
    largest = std::max({largest, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  return static_cast<float>(0x1p-18 * largest + 1e-5 * length(high - low));
}

}  // namespace steradian::scene
