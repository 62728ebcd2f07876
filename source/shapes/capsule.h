// Capsules (tubes) as lights.
#pragma once

#include <array>

#include "shapes/polygon.h"
#include "steradian/area_light.h"

namespace steradian::packed {

struct FloatCapsule {
  Vec3f end_a{}, end_b{};
  float radius = 0;
  Vec3f half_axis{};  // from the middle to end_b: the difference of near ends would leave little but rounding

  template <class Use>
  bool any_bound(Use use) const {
    return use(end_a, radius) || use(end_b, radius);
  }
};

inline FloatCapsule prepare_capsule(const steradian::Capsule& c) {
  return {static_cast<Vec3f>(c.end_a), static_cast<Vec3f>(c.end_b), static_cast<float>(c.radius),
          static_cast<Vec3f>((c.end_b - c.end_a) * 0.5)};
}

}  // namespace steradian::packed

STERADIAN_BEGIN_ISA
namespace shapes {

// A lobe as the polygons of round lights need it: its axis in the shading frame, its width [rad], and the number of corners.
template <class S>
struct AboutLobe {
  typename Kernels<S>::vec3 axis;
  Real<S> width;
  int corners;  // 12, or 16 for high quality (docs/theory/ggx.md)
};
inline constexpr int kMostCorners = 32;  // near a rim: ellipse.h
template <class S>
using Corners = std::array<typename Kernels<S>::vec3, static_cast<std::size_t>(kMostCorners)>;

// The capsule as seen from the point p, in the shading frame, in units of its distance.
template <class S>
STERADIAN_INLINE auto capsule_in(const packed::FloatCapsule& light, const typename Kernels<S>::mat3& frame,
                                 const typename Kernels<S>::vec3& p) {
  const auto a = transform_transposed(frame, to_kernel<S>(light.end_a) - p);
  const auto b = transform_transposed(frame, to_kernel<S>(light.end_b) - p);
  return Kernels<S>().capsule_in_units(a, b, static_cast<double>(light.radius));
}

// These are functions of their own: inlined, they would take registers from the walks of polygons.
template <class S>
__attribute__((flatten, noinline)) Seen<S> see(const packed::FloatCapsule& light, const typename Kernels<S>::vec3& p) {
  using vec3 = typename Kernels<S>::vec3;
  Seen<S> seen;
  seen.lit = capsule_in<S>(light, typename Kernels<S>::mat3(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)), p).outside;
  seen.reversed = Kernels<S>().mask_none();
  return seen;
}

template <class S>
STERADIAN_INLINE Real<S> distance2(const packed::FloatCapsule& light, const typename Kernels<S>::vec3& p) {
  const auto to = (to_kernel<S>(light.end_a) + to_kernel<S>(light.end_b)) * Real<S>(0.5) - p;
  return dot(to, to);
}

// An upper bound of the light's mean square extent.
template <class S>
Real<S> deviation2(const packed::FloatCapsule& light) {
  return static_cast<double>(dot(light.half_axis, light.half_axis) + light.radius * light.radius);
}

template <class S>
typename Kernels<S>::LightElements elements(const packed::FloatCapsule& light, const typename Kernels<S>::vec3& p) {
  const auto a = to_kernel<S>(light.end_a) - p, b = to_kernel<S>(light.end_b) - p;
  return Kernels<S>().capsule_elements((a + b) * Real<S>(0.5), to_kernel<S>(light.half_axis) * Real<S>(2.0),
                                       static_cast<double>(light.radius));
}

// Irradiance by the outline alone, which float loses where the capsule is small: ellipse.h has the complete function.
template <class S>
__attribute__((flatten, noinline)) typename Kernels<S>::vec3 outline_irradiance_vector(const packed::FloatCapsule& light,
                                                                                       const typename Kernels<S>::mat3& frame,
                                                                                       const typename Kernels<S>::vec3& p) {
  return Kernels<S>().capsule_irradiance_vector(capsule_in<S>(light, frame, p));
}

template <class S>
STERADIAN_INLINE int fill_corners(const packed::FloatCapsule& light, const AboutLobe<S>& lobe, const typename Kernels<S>::mat3& frame,
                                  const typename Kernels<S>::vec3& p, Corners<S>& corners) {
  Kernels<S> k;
  const auto fan = k.capsule_fan(capsule_in<S>(light, frame, p), lobe.axis, lobe.width, lobe.corners);
  for (int i = 0; i < lobe.corners; ++i) corners[static_cast<std::size_t>(i)] = k.polygon_direction(k.capsule_fan_corner(fan, i));
  return lobe.corners;
}

}  // namespace shapes
STERADIAN_END_ISA
