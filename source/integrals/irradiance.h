// Irradiance and solid angle as integrals over an outline: Lambert's and Girard's (kernels/outline/polygon.glsl).
#pragma once

#include "integrals/integrate.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// The irradiance vector for radiance 1; its z is the irradiance, in [0, pi].
template <class S>
class Irradiance {
 public:
  static constexpr Clip kClip = Clip::none;
  using vec3 = typename Kernels<S>::vec3;

  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    walk_ = Kernels<S>().polygon_begin();
    return shading.lit;
  }
  STERADIAN_INLINE vec3 end(const vec3& u) const { return u; }
  STERADIAN_INLINE void add(const vec3& a, const vec3& b) { walk_ = Kernels<S>().polygon_add_edge(walk_, a, b); }
  STERADIAN_INLINE vec3 finish(Mask<S> reversed) { return Kernels<S>().polygon_irradiance_vector(walk_, reversed); }

  STERADIAN_INLINE Real<S> least_distance2() const { return Kernels<S>().light_elements_along_edges().least_distance2; }
  SmallLight<S> small_light(const vec3&) const {
    return {Kernels<S>().light_elements_diffuse_sharpness(), Kernels<S>().light_elements_along_edges()};
  }
  vec3 at(const vec3& u) const { return u; }

 private:
  typename Kernels<S>::PolygonWalk walk_;
};

// x: the solid angle of the whole light, in [0, 2 pi].
template <class S>
class SolidAngle {
 public:
  static constexpr Clip kClip = Clip::none;
  using vec3 = typename Kernels<S>::vec3;

  // apex: the unit direction of any corner of the light.
  STERADIAN_INLINE explicit SolidAngle(const vec3& apex) : apex_(apex) {}
  STERADIAN_INLINE Mask<S> begin(const Shading<S>& shading) {
    walk_ = Kernels<S>().solid_angle_begin(apex_);
    return shading.lit;
  }
  STERADIAN_INLINE vec3 end(const vec3& u) const { return u; }
  STERADIAN_INLINE void add(const vec3& a, const vec3& b) { walk_ = Kernels<S>().solid_angle_add_edge(walk_, a, b); }
  STERADIAN_INLINE Part<S> finish(Mask<S> reversed) { return {Kernels<S>().solid_angle_finish(walk_, reversed), Real<S>(0.0)}; }

 private:
  vec3 apex_;
  typename Kernels<S>::SolidAngleWalk walk_;
};

}  // namespace integrals
STERADIAN_END_ISA
