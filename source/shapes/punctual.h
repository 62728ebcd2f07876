// Point, spot and directional lights of glTF (KHR_lights_punctual).
#pragma once

#include <algorithm>
#include <cmath>

#include "integrals/outline.h"
#include "steradian/scene.h"

namespace steradian::packed {

// What is per light. Distances are squared: range^-2 and the spot's line from the cosine of the angle to its square root.
struct Punctual {
  PunctualKind kind = PunctualKind::point;
  Vec3d position, direction{0, 0, -1};
  double inverse_range2 = 0;  // 0: no limit
  double spot_scale = 0, spot_offset = 1;

  template <class Use>
  bool any_bound(Use use) const {
    return use(static_cast<Vec3f>(position), 0.0f);
  }
};

inline Punctual prepare(const PunctualLight& p) {
  Punctual light{p.kind, p.position, p.direction};
  if (std::isfinite(p.range) && p.range > 0) light.inverse_range2 = 1 / (p.range * p.range);
  if (p.kind == PunctualKind::spot) {  // "inner and outer cone angles"
    light.spot_scale = 1 / std::max(0.001, p.cos_inner - p.cos_outer);
    light.spot_offset = -p.cos_outer * light.spot_scale;
  }
  return light;
}

}  // namespace steradian::packed

STERADIAN_BEGIN_ISA
namespace shapes {

// For intensity 1 (illuminance 1 of a directional light).
template <class S>
struct Incident {
  Real<S> irradiance;                   // across the direction
  typename Kernels<S>::vec3 direction;  // unit, to the light
};

template <class S>
STERADIAN_INLINE Incident<S> incident(const packed::Punctual& light, const typename Kernels<S>::vec3& p) {
  using R = Real<S>;
  const auto along = integrals::to_kernel<S>(light.direction);
  if (light.kind == PunctualKind::directional) return {R(1.0), -along};
  const auto to = integrals::to_kernel<S>(light.position) - p;
  const R d2 = max(dot(to, to), R(1e-12));
  const auto direction = to * inversesqrt(d2);
  R e = R(1.0) / d2;
  if (light.inverse_range2 > 0) {
    const R q = d2 * R(light.inverse_range2);
    e = e * clamp(R(1.0) - q * q, R(0.0), R(1.0));
  }
  if (light.kind == PunctualKind::spot) {
    const R f = clamp(-dot(along, direction) * R(light.spot_scale) + R(light.spot_offset), R(0.0), R(1.0));
    e = e * f * f;
  }
  return {e, direction};
}

}  // namespace shapes
STERADIAN_END_ISA
