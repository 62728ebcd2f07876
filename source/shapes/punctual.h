// Point, spot and directional lights of glTF (KHR_lights_punctual), and points with a profile (EXT_lights_ies).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "shapes/outline.h"
#include "steradian/scene.h"

namespace steradian::packed {

// Data of one light, as in kernels/outline/punctual.glsl.
struct Punctual {
  PunctualKind kind = PunctualKind::point;
  Vec3d position, direction{0, 0, -1};
  double inverse_range2 = 0;
  double spot_scale = 0, spot_offset = 1;
  const LightProfile* profile = nullptr;  // owned by the PunctualLight, which must outlive this
  ProfileAxes axes{};

  template <class Use>
  bool any_bound(Use use) const {
    return use(static_cast<Vec3f>(position), 0.0f);
  }
};

// Candela in a direction from the light. It is not inlined, since it looks a table up with branches: lanes are evaluated one by one.
double profile_intensity(const Punctual& light, double x, double y, double z);

inline Punctual prepare(const PunctualLight& p) {
  Punctual light{p.kind, p.position, p.direction};
  light.profile = p.profile.get();
  light.axes = p.profile_axes;
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

// Factor of the light's profile on its intensity in the direction from it, lane by lane in double.
template <class S>
Real<S> profile_factor(const packed::Punctual& light, const typename Kernels<S>::vec3& from_light) {
  if constexpr (std::is_floating_point_v<S>) {
    return Real<S>(packed::profile_intensity(light, static_cast<double>(from_light.x.v), static_cast<double>(from_light.y.v),
                                             static_cast<double>(from_light.z.v)));
  } else {
    alignas(64) float x[S::size], y[S::size], z[S::size];
    from_light.x.v.store_unaligned(x);
    from_light.y.v.store_unaligned(y);
    from_light.z.v.store_unaligned(z);
    for (std::size_t i = 0; i < S::size; ++i)
      x[i] = static_cast<float>(
          packed::profile_intensity(light, static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])));
    return Real<S>::of(S::load_unaligned(x));
  }
}

// Incident light for intensity 1 (illuminance 1 of a directional light).
template <class S>
STERADIAN_INLINE typename Kernels<S>::PunctualIncident incident(const packed::Punctual& light, const typename Kernels<S>::vec3& p) {
  using R = Real<S>;
  const auto along = integrals::to_kernel<S>(light.direction);
  if (light.kind == PunctualKind::directional) return {-along, R(1.0)};
  auto incident = Kernels<S>().punctual_incident(
      {integrals::to_kernel<S>(light.position), along, R(light.inverse_range2), R(light.spot_scale), R(light.spot_offset)}, p);
  if (light.profile != nullptr) incident.irradiance = incident.irradiance * profile_factor<S>(light, -incident.direction);
  return incident;
}

}  // namespace shapes
STERADIAN_END_ISA
