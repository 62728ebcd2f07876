// Point, spot and directional lights of glTF (KHR_lights_punctual).
#pragma once

#include <algorithm>
#include <cmath>

#include "shapes/outline.h"
#include "steradian/scene.h"

namespace steradian::packed {

// What is per light, as of kernels/outline/punctual.glsl.
struct Punctual {
  PunctualKind kind = PunctualKind::point;
  Vec3d position, direction{0, 0, -1};
  double inverse_range2 = 0;
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
STERADIAN_INLINE typename Kernels<S>::PunctualIncident incident(const packed::Punctual& light, const typename Kernels<S>::vec3& p) {
  using R = Real<S>;
  const auto along = integrals::to_kernel<S>(light.direction);
  if (light.kind == PunctualKind::directional) return {-along, R(1.0)};
  return Kernels<S>().punctual_incident(
      {integrals::to_kernel<S>(light.position), along, R(light.inverse_range2), R(light.spot_scale), R(light.spot_offset)}, p);
}

}  // namespace shapes
STERADIAN_END_ISA
