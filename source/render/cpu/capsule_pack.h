// Capsules on packs: their irradiance, and the corners that stand for their outline under a lobe.
#pragma once

#include <array>

#include "core/pack.h"
#include "render/cpu/light_list.h"

STERADIAN_BEGIN_ISA

inline constexpr int kMostCapsuleCorners = 16;
using CapsuleCorners = std::array<PackVec3, kMostCapsuleCorners>;

// The capsule from the point p in the shading frame, in units of its distance.
STERADIAN_INLINE PackKernels::Capsule capsule_in_frame(const PackLight& light, const PackKernels::mat3& frame, const PackVec3& p) {
  PackKernels k;
  const PackVec3 a = transform_transposed(frame, broadcast(light.end_a) - p);
  const PackVec3 b = transform_transposed(frame, broadcast(light.end_b) - p);
  const PackReal radius = broadcast(light.radius);
  const PackReal unit = inversesqrt(max(dot(a, a) + dot(b, b) + radius * radius, PackReal(1.0e-30)));
  return k.capsule_prepare(a * unit, b * unit, radius * unit);
}

// Functions of their own: inlined, they would take registers from the walks of polygons.
__attribute__((flatten, noinline)) inline PackReal capsule_irradiance(const PackLight& light, const PackKernels::mat3& frame,
                                                                      const PackVec3& p) {
  PackKernels k;
  return k.capsule_irradiance_vector(capsule_in_frame(light, frame, p)).z;
}

__attribute__((flatten, noinline)) inline PackKernels::mask is_outside_capsule(const PackLight& light, const PackVec3& p) {
  const PackVec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  return capsule_in_frame(light, PackKernels::mat3(x, y, z), p).outside;
}

//   axis, width  of the lobe, in the frame: see kernels/outline/capsule.glsl, capsule_fan
__attribute__((flatten, noinline)) inline void capsule_corners(const PackLight& light, int corners, const PackKernels::mat3& frame,
                                                               const PackVec3& p, const PackVec3& axis, const PackReal& width,
                                                               CapsuleCorners& result) {
  PackKernels k;
  const auto fan = k.capsule_fan(capsule_in_frame(light, frame, p), axis, width, corners);
  for (int i = 0; i < corners; ++i)
    result[static_cast<std::size_t>(i)] = k.polygon_direction(k.capsule_fan_corner(fan, i));
}

STERADIAN_END_ISA
