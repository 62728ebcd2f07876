// Facets of a GGX surface that are visible from a view, and the light that each reflects.
// Source: the visible normals and their density: Heitz, "Sampling the GGX distribution of visible normals", 2018, algorithm 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "steradian/texture.h"  // Vec2f
#include "steradian/vector.h"

namespace steradian::lobes {

// A direction from which a facet reflects light to the view.
struct FacetDirection {
  Vec3f to;               // unit, in the lobe's frame, above its surface
  float weight, grazing;  // G2 / G1, and (1 - v.h)^5
  float density;          // of the directions, per solid angle
};

// Finds facets of equal probability in float, by `count` points of the unit disc: point(i). It leaves out those that reflect the view below
// the surface.
//
//   view  unit, in the lobe's frame, above its surface
template <class Point, class Use>
void each_visible_facet(Vec3f view, float ax, float ay, std::size_t count, Point point, Use use) {
  const auto stretched_length = [&](Vec3f w) { return std::sqrt(ax * ax * w.x * w.x + ay * ay * w.y * w.y + w.z * w.z); };
  const float view_length = stretched_length(view);
  const Vec3f v = Vec3f{ax * view.x, ay * view.y, view.z} * (1 / view_length);
  const float square = v.x * v.x + v.y * v.y;
  const Vec3f t1 = square > 0 ? Vec3f{-v.y, v.x, 0} * (1 / std::sqrt(square)) : Vec3f{1, 0, 0}, t2 = cross(v, t1);
  const float s = 0.5f * (1 + v.z);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2f disc = point(i);
    const float p1 = disc.x, p2 = (1 - s) * std::sqrt(std::max(1 - p1 * p1, 0.0f)) + s * disc.y;
    const Vec3f n = t1 * p1 + t2 * p2 + v * std::sqrt(std::max(1 - p1 * p1 - p2 * p2, 0.0f));
    const Vec3f h = normalized(Vec3f{ax * n.x, ay * n.y, std::max(n.z, 1e-6f)});
    const float v_dot_h = dot(view, h);
    const Vec3f l = h * (2 * v_dot_h) - view;
    if (!(l.z > 0) || !(v_dot_h > 0)) continue;
    const float light_length = stretched_length(l);
    // G2 / G1 = l.z (|Av| + v.z) / (l.z |Av| + v.z |Al|), where |Aw| is the length in the stretched space.
    const float weight = l.z * (view_length + view.z) / (l.z * view_length + view.z * light_length);
    // Density per solid angle: G1 D / (4 v.z), G1 = 2 v.z / (v.z + |Av|).
    const float k = h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay) + h.z * h.z;
    const float density = 1 / (2 * (view.z + view_length) * static_cast<float>(std::numbers::pi) * ax * ay * k * k);
    const float c = std::max(1 - v_dot_h, 0.0f);
    use(FacetDirection{l, weight, c * c * c * c * c, density});
  }
}

}  // namespace steradian::lobes
