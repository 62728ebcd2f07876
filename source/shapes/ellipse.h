// Disks, ellipses, spheres and ellipsoids as lights: each appears as one ellipse from a point.
#pragma once

#include <algorithm>
#include <cmath>

#include "shapes/capsule.h"
#include "shapes/polygon.h"
#include "shapes/small_light.h"
#include "steradian/area_light.h"

namespace steradian::packed {

template <class Use>
bool any_corner(Vec3f center, Vec3f x, Vec3f y, Vec3f z, Use use) {
  for (int i = 0; i < 8; ++i)
    if (use(center + x * ((i & 1) != 0 ? 1.0f : -1.0f) + y * ((i & 2) != 0 ? 1.0f : -1.0f) + z * ((i & 4) != 0 ? 1.0f : -1.0f), 0.0f))
      return true;
  return false;
}

struct FloatDisk {
  Vec3f point{}, x{}, y{}, normal{};  // centre, conjugate half axes; the normal to the lit side, NaN without area
  bool two_sided = false;

  template <class Use>
  bool any_bound(Use use) const {
    return any_corner(point, x, y, {}, use);
  }
};

struct FloatEllipsoid {
  Vec3f center{}, x{}, y{}, z{};                // half axes
  Vec3f inverse_x{}, inverse_y{}, inverse_z{};  // rows of the matrix that maps it to the unit sphere; NaN without volume
  FloatCapsule ball;                            // a ball is also a capsule, whose irradiance is faster to compute; else of radius 0

  template <class Use>
  bool any_bound(Use use) const {
    return any_corner(center, x, y, z, use);
  }
};

inline FloatDisk prepare_disk(const steradian::Ellipse& a, bool two_sided) {
  const Vec3d normal = cross(a.x, a.y);
  return {static_cast<Vec3f>(a.center), static_cast<Vec3f>(a.x), static_cast<Vec3f>(a.y), static_cast<Vec3f>(normal / length(normal)),
          two_sided};
}

// True for three axes of one length, at right angles, up to the rounding of a node's rotation.
inline bool is_ball(const steradian::Ellipsoid& a) {
  const double r2 = dot(a.x, a.x), least = 1e-6 * r2;
  const auto off = [&](double x) { return std::fabs(x) > least; };
  return !off(dot(a.y, a.y) - r2) && !off(dot(a.z, a.z) - r2) && !off(dot(a.x, a.y)) && !off(dot(a.y, a.z)) && !off(dot(a.z, a.x));
}

inline FloatEllipsoid prepare_ellipsoid(const steradian::Ellipsoid& a) {
  const double det = dot(a.x, cross(a.y, a.z));
  const auto single = [](Vec3d v) { return static_cast<Vec3f>(v); };
  FloatEllipsoid light = {single(a.center),
                          single(a.x),
                          single(a.y),
                          single(a.z),
                          single(cross(a.y, a.z) / det),
                          single(cross(a.z, a.x) / det),
                          single(cross(a.x, a.y) / det),
                          {}};
  if (is_ball(a)) light.ball = {light.center, light.center, static_cast<float>(length(a.x)), {}};
  return light;
}

}  // namespace steradian::packed

STERADIAN_BEGIN_ISA
namespace shapes {

template <class S>
STERADIAN_INLINE Seen<S> see(const packed::FloatDisk& light, const typename Kernels<S>::vec3& p) {
  return {see_plane<S>(light, p).lit, Kernels<S>().mask_none()};  // its outline is walked in its visible order
}

// The outline as seen from the point p.
template <class S>
STERADIAN_INLINE typename Kernels<S>::EllipsoidOutline outline_from(const packed::FloatDisk& light, const typename Kernels<S>::vec3& p) {
  return {to_kernel<S>(light.point) - p, to_kernel<S>(light.x), to_kernel<S>(light.y), Kernels<S>().mask_all()};
}

template <class S>
STERADIAN_INLINE typename Kernels<S>::EllipsoidOutline outline_from(const packed::FloatEllipsoid& light,
                                                                    const typename Kernels<S>::vec3& p) {
  const auto column = [](float x, float y, float z) { return to_kernel<S>(Vec3f{x, y, z}); };
  const typename Kernels<S>::mat3 axes(to_kernel<S>(light.x), to_kernel<S>(light.y), to_kernel<S>(light.z));
  const typename Kernels<S>::mat3 inverse(column(light.inverse_x.x, light.inverse_y.x, light.inverse_z.x),
                                          column(light.inverse_x.y, light.inverse_y.y, light.inverse_z.y),
                                          column(light.inverse_x.z, light.inverse_y.z, light.inverse_z.z));
  return Kernels<S>().ellipsoid_outline(to_kernel<S>(light.center) - p, axes, inverse);
}

template <class S>
STERADIAN_INLINE Seen<S> see(const packed::FloatEllipsoid& light, const typename Kernels<S>::vec3& p) {
  return {outline_from<S>(light, p).outside, Kernels<S>().mask_none()};
}

// The same in the shading frame, in units of its distance: squares of squares stay in the range of float.
template <class S, class Round>
STERADIAN_INLINE auto ellipse_in(const Round& light, const typename Kernels<S>::mat3& frame, const typename Kernels<S>::vec3& p) {
  const auto outline = outline_from<S>(light, p);
  return Kernels<S>().ellipse_in_units(frame, outline.center, outline.axis_a, outline.axis_b);
}

// Mean squares of the lights' extents; an ellipsoid's is an upper bound.
template <class S>
STERADIAN_INLINE Real<S> deviation2(const packed::FloatDisk& light) {
  return static_cast<double>((dot(light.x, light.x) + dot(light.y, light.y)) / 4);
}
template <class S>
STERADIAN_INLINE Real<S> deviation2(const packed::FloatEllipsoid& light) {
  return static_cast<double>(dot(light.x, light.x) + dot(light.y, light.y) + dot(light.z, light.z));
}

template <class S>
STERADIAN_INLINE Real<S> distance2(const packed::FloatDisk& light, const typename Kernels<S>::vec3& p) {
  const auto to = to_kernel<S>(light.point) - p;
  return dot(to, to);
}
template <class S>
STERADIAN_INLINE Real<S> distance2(const packed::FloatEllipsoid& light, const typename Kernels<S>::vec3& p) {
  const auto to = to_kernel<S>(light.center) - p;
  return dot(to, to);
}

template <class S, class Round>
typename Kernels<S>::LightElements elements_of_outline(const Round& light, const typename Kernels<S>::vec3& p) {
  Kernels<S> k;
  const auto outline = outline_from<S>(light, p);
  return k.ellipse_elements(k.ellipse_prepare(outline.center, outline.axis_a, outline.axis_b));
}
template <class S>
typename Kernels<S>::LightElements elements(const packed::FloatDisk& light, const typename Kernels<S>::vec3& p) {
  return elements_of_outline<S>(light, p);
}
template <class S>
typename Kernels<S>::LightElements elements(const packed::FloatEllipsoid& light, const typename Kernels<S>::vec3& p) {
  return elements_of_outline<S>(light, p);
}

// Elements of any shape, in the shading frame. The function is here because all shapes are declared here.
template <class S, class Shape>
typename Kernels<S>::LightElements elements_in(const Shape& light, const typename Kernels<S>::mat3& frame,
                                               const typename Kernels<S>::vec3& p) {
  const auto e = elements<S>(light, p);
  return {transform_transposed(frame, e.center), transform_transposed(frame, e.reach_a), transform_transposed(frame, e.reach_b),
          transform_transposed(frame, e.area)};
}

// Exact for radiance 1; z is the irradiance. Uses the elements where they serve.
template <class S, class Round>
STERADIAN_INLINE auto by_elements_where_small(typename Kernels<S>::vec3 e, const Round& light, const typename Kernels<S>::mat3& frame,
                                              const typename Kernels<S>::vec3& p) {
  Kernels<S> k;
  if (any_lane(distance2<S>(light, p) > deviation2<S>(light) * k.light_elements_along_arcs().least_distance2)) {
    const auto elements = elements_in<S>(light, frame, p);
    const auto serve = integrals::elements_serve<S>(elements, {k.light_elements_diffuse_sharpness(), k.light_elements_along_arcs()});
    e = select(serve, k.light_elements_irradiance_vector(elements), e);
  }
  return e;
}
template <class S>
__attribute__((flatten, noinline)) auto irradiance_vector(const packed::FloatDisk& light, const typename Kernels<S>::mat3& frame,
                                                          const typename Kernels<S>::vec3& p) {
  return by_elements_where_small<S>(Kernels<S>().ellipse_irradiance_vector(ellipse_in<S>(light, frame, p)), light, frame, p);
}
template <class S>
__attribute__((flatten, noinline)) auto irradiance_vector(const packed::FloatCapsule& light, const typename Kernels<S>::mat3& frame,
                                                          const typename Kernels<S>::vec3& p) {
  return by_elements_where_small<S>(outline_irradiance_vector<S>(light, frame, p), light, frame, p);
}
template <class S>
__attribute__((flatten, noinline)) auto irradiance_vector(const packed::FloatEllipsoid& light, const typename Kernels<S>::mat3& frame,
                                                          const typename Kernels<S>::vec3& p) {
  const auto e = light.ball.radius > 0 ? outline_irradiance_vector<S>(light.ball, frame, p)
                                       : Kernels<S>().ellipse_irradiance_vector(ellipse_in<S>(light, frame, p));
  return by_elements_where_small<S>(e, light, frame, p);
}

// Number of corners near the rim: kernels/outline/ellipse.glsl, ellipse_fan_near.
inline constexpr int kCornersNearRim = 32;
static_assert(kCornersNearRim <= kMostCorners);

template <class S>
STERADIAN_INLINE void fill_corners_of_fan(const typename Kernels<S>::EllipseFan& fan, int count, Corners<S>& corners) {
  Kernels<S> k;
  auto before = k.ellipse_corner(fan, -1, count), here = k.ellipse_corner(fan, 0, count);
  for (int i = 0; i < count; ++i) {
    const auto after = k.ellipse_corner(fan, i + 1, count);
    corners[static_cast<std::size_t>(i)] = k.polygon_direction(k.ellipse_pushed_corner(fan, before, here, after));
    before = here;
    here = after;
  }
}

// Lanes whose rim is not near get the corners that they would have alone; the last one is repeated to fill the count. Rarely called, hence
// not inlined.
template <class S>
__attribute__((flatten, noinline)) void keep_usual_corners(typename Kernels<S>::EllipseFan fan, int usual_count, int count,
                                                           Corners<S>& corners) {
  const auto near = fan.near;
  fan.near = Kernels<S>().mask_none();
  Corners<S> usual;
  fill_corners_of_fan<S>(fan, usual_count, usual);
  for (int i = 0; i < count; ++i) {
    auto& corner = corners[static_cast<std::size_t>(i)];
    corner = select(near, corner, usual[static_cast<std::size_t>(std::min(i, usual_count - 1))]);
  }
}

// Fills the corners of a lobe's polygon for the outline, in walk order; returns their number.
template <class S, class Round>
STERADIAN_INLINE int fill_corners(const Round& light, const AboutLobe<S>& lobe, const typename Kernels<S>::mat3& frame,
                                  const typename Kernels<S>::vec3& p, Corners<S>& corners) {
  Kernels<S> k;
  const auto fan = k.ellipse_fan_concentrated(ellipse_in<S>(light, frame, p), lobe.axis, lobe.width);
  const int count = any_lane(fan.near) ? std::max(lobe.corners, kCornersNearRim) : lobe.corners;
  fill_corners_of_fan<S>(fan, count, corners);
  if (count != lobe.corners && !all_lanes(fan.near)) keep_usual_corners<S>(fan, lobe.corners, count, corners);
  return count;
}

}  // namespace shapes
STERADIAN_END_ISA
