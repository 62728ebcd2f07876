// Polygons as lights: the lit side, and their contours as an outline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "shapes/outline.h"
#include "steradian/polygon_light.h"

namespace steradian::packed {

// A point has no side of a flat light nearer to its plane than the rounding of single precision, as in PreparedPolygon::side_of: 8 units in
// the last place of the lengths of both positions. The square of that is at most this times the sum of the lengths' squares.
inline constexpr double kRounding2 = 2 * (8 * 0x1p-23) * (8 * 0x1p-23);

// A polygon in single precision, as packs read it.
struct FloatPolygon {
  std::vector<Vec3f> vertices;        // in walk order
  std::vector<std::size_t> contours;  // as in PreparedPolygon
  Vec3f normal{}, point{};            // of its plane; the normal to the lit side
  bool two_sided = false;
  Vec3f middle{}, reach_a{}, reach_b{}, area{};  // its LightQuarters; area is the normal times the area
  float deviation2 = 0;                          // mean square of its extent about its middle [m2]

  // True if `use(point, radius)` holds for one of the balls whose hull contains the light.
  template <class Use>
  bool any_bound(Use use) const {
    return std::any_of(vertices.begin(), vertices.end(), [&](Vec3f v) { return use(v, 0.0f); });
  }
};

inline FloatPolygon prepare(const PreparedPolygon& light) {
  FloatPolygon result;
  for (const Vec3d& v : light.vertices) result.vertices.push_back(static_cast<Vec3f>(v));
  result.contours = light.contours;
  result.normal = static_cast<Vec3f>(light.normal);
  // The point of its plane nearest to the origin: those of a large light are as far away as rounding is coarse.
  result.point = static_cast<Vec3f>(light.normal * dot(light.normal, light.centroid));
  result.two_sided = light.two_sided;
  const LightQuarters& q = light.quarters;
  result.middle = static_cast<Vec3f>(q.center);
  result.reach_a = static_cast<Vec3f>(q.reach_a);
  result.reach_b = static_cast<Vec3f>(q.reach_b);
  result.area = static_cast<Vec3f>(light.normal * light.area);
  result.deviation2 = static_cast<float>((dot(q.reach_a, q.reach_a) + dot(q.reach_b, q.reach_b)) / 2);
  return result;
}

}  // namespace steradian::packed

STERADIAN_BEGIN_ISA
namespace shapes {

using integrals::to_kernel;

// 1 or -1 if the light is seen from the front or the back, 0 if it sends nothing to the point.
inline int lit_side(const PreparedPolygon& light, Vec3d position) {
  const int side = light.side_of(position);
  return side < 0 && !light.two_sided ? 0 : side;
}

// Visibility of a light's sides from the points of a pack.
template <class S>
struct Seen {
  Mask<S> lit, reversed;
};

// Sides of a flat light, a polygon or disk, as seen from the points.
template <class S, class Flat>
STERADIAN_INLINE Seen<S> see_plane(const Flat& light, const typename Kernels<S>::vec3& p) {
  Seen<S> seen;
  const auto point = to_kernel<S>(light.point);
  const Real<S> height = dot(p - point, to_kernel<S>(light.normal)), zero(0.0);
  const Mask<S> apart = height * height > Real<S>(packed::kRounding2) * (dot(p, p) + dot(point, point));
  seen.reversed = height < zero;
  seen.lit = light.two_sided ? apart : apart && height > zero;
  return seen;
}

template <class S>
STERADIAN_INLINE Seen<S> see(const packed::FloatPolygon& light, const typename Kernels<S>::vec3& p) {
  return see_plane<S>(light, p);
}

// Elements of a light in the world's frame, about the point: shapes/small_light.h.
template <class S>
typename Kernels<S>::LightElements elements(const packed::FloatPolygon& light, const typename Kernels<S>::vec3& p) {
  return {to_kernel<S>(light.middle) - p, to_kernel<S>(light.reach_a), to_kernel<S>(light.reach_b), to_kernel<S>(light.area)};
}

// Square of the distance to the light's middle.
template <class S>
STERADIAN_INLINE Real<S> distance2(const packed::FloatPolygon& light, const typename Kernels<S>::vec3& p) {
  const auto to = to_kernel<S>(light.middle) - p;
  return dot(to, to);
}

template <class S>
STERADIAN_INLINE Real<S> deviation2(const packed::FloatPolygon& light) {
  return static_cast<double>(light.deviation2);
}

template <class S>
STERADIAN_INLINE auto contours_in(const packed::FloatPolygon& light, const typename Kernels<S>::mat3& frame,
                                  const typename Kernels<S>::vec3& p) {
  const auto direction = [&frame, &p](const Vec3f& v) {
    return Kernels<S>().polygon_direction(transform_transposed(frame, to_kernel<S>(v) - p));
  };
  return integrals::Contours<Vec3f, decltype(direction)>{light.vertices.data(), light.contours.data(), light.contours.size() - 1,
                                                         direction};
}

}  // namespace shapes
STERADIAN_END_ISA
