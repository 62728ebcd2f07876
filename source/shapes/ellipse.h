// Disks, ellipses, spheres and ellipsoids as lights: what a point sees of each is one ellipse.
#pragma once

#include <algorithm>
#include <cmath>

#include "integrals/small_light.h"
#include "shapes/capsule.h"
#include "shapes/polygon.h"
#include "steradian/area_light.h"

namespace steradian::packed {

template <class Use>
bool any_corner(Vec3f center, Vec3f x, Vec3f y, Vec3f z, Use use) {
  for (int i = 0; i < 8; ++i)
    if (use(center + x * ((i & 1) != 0 ? 1.0f : -1.0f) + y * ((i & 2) != 0 ? 1.0f : -1.0f) + z * ((i & 4) != 0 ? 1.0f : -1.0f), 0.0f))
      return true;
  return false;
}

struct Disk {
  Vec3f point{}, x{}, y{}, normal{};  // centre, conjugate half axes; the normal to the lit side, not a number without area
  bool two_sided = false;

  template <class Use>
  bool any_bound(Use use) const {
    return any_corner(point, x, y, {}, use);
  }
};

struct Ellipsoid {
  Vec3f center{}, x{}, y{}, z{};             // half axes
  Vec3f inverse_x{}, inverse_y{}, inverse_z{};  // rows of the matrix that takes it to the unit sphere; not numbers without volume
  Capsule ball;                              // a ball is a capsule, too, whose irradiance is the quicker; else of radius 0

  template <class Use>
  bool any_bound(Use use) const {
    return any_corner(center, x, y, z, use);
  }
};

inline Disk prepare_disk(const AreaLight& a) {
  const Vec3d normal = cross(a.x, a.y);
  return {static_cast<Vec3f>(a.center), static_cast<Vec3f>(a.x), static_cast<Vec3f>(a.y), static_cast<Vec3f>(normal / length(normal)),
          a.polygon.two_sided};
}

// Three axes of one length, at right angles, up to the rounding of a node's rotation.
inline bool is_ball(const AreaLight& a) {
  const double r2 = dot(a.x, a.x), least = 1e-6 * r2;
  const auto off = [&](double x) { return std::fabs(x) > least; };
  return !off(dot(a.y, a.y) - r2) && !off(dot(a.z, a.z) - r2) && !off(dot(a.x, a.y)) && !off(dot(a.y, a.z)) && !off(dot(a.z, a.x));
}

inline Ellipsoid prepare_ellipsoid(const AreaLight& a) {
  const double det = dot(a.x, cross(a.y, a.z));
  const auto single = [](Vec3d v) { return static_cast<Vec3f>(v); };
  Ellipsoid light = {single(a.center), single(a.x), single(a.y), single(a.z), single(cross(a.y, a.z) / det), single(cross(a.z, a.x) / det),
                     single(cross(a.x, a.y) / det), {}};
  if (is_ball(a)) light.ball = {light.center, light.center, static_cast<float>(length(a.x))};
  return light;
}

}  // namespace steradian::packed

STERADIAN_BEGIN_ISA
namespace shapes {

template <class S>
STERADIAN_INLINE Seen<S> see(const packed::Disk& light, const typename Kernels<S>::vec3& p) {
  Seen<S> seen = see_plane<S>(light, p);
  seen.outline.center = to_kernel<S>(light.point) - p;
  seen.outline.axis_a = to_kernel<S>(light.x);
  seen.outline.axis_b = to_kernel<S>(light.y);
  seen.reversed = Kernels<S>().mask_none();  // its outline is walked as it is seen
  return seen;
}

template <class S>
STERADIAN_INLINE Seen<S> see(const packed::Ellipsoid& light, const typename Kernels<S>::vec3& p) {
  const auto column = [](float x, float y, float z) { return to_kernel<S>(Vec3f{x, y, z}); };
  const typename Kernels<S>::mat3 axes(to_kernel<S>(light.x), to_kernel<S>(light.y), to_kernel<S>(light.z));
  const typename Kernels<S>::mat3 inverse(column(light.inverse_x.x, light.inverse_y.x, light.inverse_z.x),
                                          column(light.inverse_x.y, light.inverse_y.y, light.inverse_z.y),
                                          column(light.inverse_x.z, light.inverse_y.z, light.inverse_z.z));
  Seen<S> seen;
  const auto to = to_kernel<S>(light.center) - p;
  seen.outline = Kernels<S>().ellipsoid_outline(to, axes, inverse);
  seen.distance2 = dot(to, to);
  seen.lit = seen.outline.outside;
  seen.reversed = Kernels<S>().mask_none();
  return seen;
}

// The outline in the shading frame, in units of its distance: squares of squares stay in the range of float.
template <class S>
STERADIAN_INLINE auto ellipse_in(const typename Kernels<S>::EllipsoidOutline& outline, const typename Kernels<S>::mat3& frame) {
  const Real<S> size2 = dot(outline.center, outline.center) + dot(outline.axis_a, outline.axis_a) + dot(outline.axis_b, outline.axis_b);
  const Real<S> unit = inversesqrt(max(size2, Real<S>(1.0e-30)));
  return Kernels<S>().ellipse_prepare(transform_transposed(frame, outline.center) * unit, transform_transposed(frame, outline.axis_a) * unit,
                                      transform_transposed(frame, outline.axis_b) * unit);
}

// Mean squares of their extents; an ellipsoid's is an upper bound.
template <class S>
STERADIAN_INLINE Real<S> deviation2(const packed::Disk& light) {
  return static_cast<double>((dot(light.x, light.x) + dot(light.y, light.y)) / 4);
}
template <class S>
STERADIAN_INLINE Real<S> deviation2(const packed::Ellipsoid& light) {
  return static_cast<double>(dot(light.x, light.x) + dot(light.y, light.y) + dot(light.z, light.z));
}

template <class S>
typename Kernels<S>::LightElements elements(const packed::Disk&, const Seen<S>& seen, const typename Kernels<S>::vec3&) {
  Kernels<S> k;
  return k.ellipse_elements(k.ellipse_prepare(seen.outline.center, seen.outline.axis_a, seen.outline.axis_b));
}
template <class S>
typename Kernels<S>::LightElements elements(const packed::Ellipsoid&, const Seen<S>& seen, const typename Kernels<S>::vec3& p) {
  return elements<S>(packed::Disk{}, seen, p);
}

// By the elements where they serve.
template <class S, class Round>
STERADIAN_INLINE auto ellipse_irradiance_vector(const Round& light, const Seen<S>& seen, const typename Kernels<S>::mat3& frame,
                                                const typename Kernels<S>::vec3& p) {
  Kernels<S> k;
  auto e = k.ellipse_irradiance_vector(ellipse_in<S>(seen.outline, frame));
  if (any_lane(seen.lit && seen.distance2 > deviation2<S>(light) * Real<S>(integrals::kAlongArcs.least_distance2))) {
    const auto elements = elements_in<S>(light, seen, frame, p);
    const auto serve = integrals::elements_serve<S>(elements, {k.light_elements_diffuse_sharpness(), integrals::kAlongArcs.roundings});
    e = select(serve, k.light_elements_irradiance_vector(elements), e);
  }
  return e;
}

// Exact, for radiance 1; z is the irradiance.
template <class S>
STERADIAN_INLINE auto irradiance_vector(const packed::Disk& light, const Seen<S>& seen, const typename Kernels<S>::mat3& frame,
                                        const typename Kernels<S>::vec3& p) {
  return ellipse_irradiance_vector<S>(light, seen, frame, p);
}
template <class S>
STERADIAN_INLINE auto irradiance_vector(const packed::Ellipsoid& light, const Seen<S>& seen, const typename Kernels<S>::mat3& frame,
                                        const typename Kernels<S>::vec3& p) {
  if (light.ball.radius > 0) return irradiance_vector<S>(light.ball, seen, frame, p);
  return ellipse_irradiance_vector<S>(light, seen, frame, p);
}

// Of a polygon where the rim is near: kernels/outline/ellipse.glsl, ellipse_fan_near.
inline constexpr int kCornersNearRim = 24;

// Calls use(corner, count) with the function of the corners that stand for the outline about a lobe, and their number.
template <class S, class Round, class Use>
STERADIAN_INLINE void with_corners(const Round&, const Seen<S>& seen, const AboutLobe<S>& lobe, const typename Kernels<S>::mat3& frame,
                                   const typename Kernels<S>::vec3&, Use use) {
  Kernels<S> k;
  const auto fan = k.ellipse_fan_concentrated(ellipse_in<S>(seen.outline, frame), lobe.axis, lobe.width);
  const int count = any_lane(fan.near) ? std::max(lobe.corners, kCornersNearRim) : lobe.corners;
  use([&](int i) { return k.polygon_direction(k.ellipse_fan_corner(fan, i, count)); }, count);
}

}  // namespace shapes
STERADIAN_END_ISA
