// GGX by the representative point (kernels/comparison/representative_point.glsl), for comparison.
#pragma once

#include "integrals/integrate.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// How the lobe is widened: the kernel's way, or as published, without the factor 1/sqrt(v.h) and limited to 1.
enum class Widening { by_half_vectors, published };

template <class S>
class RepresentativePoint {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using K = Kernels<S>;
  using vec3 = typename K::vec3;

  explicit RepresentativePoint(Real<S> alpha, Widening widening = Widening::by_half_vectors) : alpha_(alpha), widening_(widening) {}
  Mask<S> begin(const Shading<S>& shading) {
    view_ = shading.view;
    mirror_ = K().phong_mirror(view_);
    walk_ = K().representative_begin();
    // Any apex serves: clipping closes the walk.
    solid_angle_ = K().solid_angle_begin(vec3(0.0, 0.0, 1.0));
    return shading.lit && view_.z > Real<S>(0.0);
  }
  vec3 end(const vec3& u) const { return u; }
  void add(const vec3& a, const vec3& b) {
    const auto next = K().representative_add_edge(walk_, mirror_, a, b);
    // If the horizon cuts other lanes of a pack, this one gets edges without length, which are not on its outline.
    const auto counts = dot(b - a, b - a) > Real<S>(1e-14);
    walk_ = {next.turn, select(counts, next.nearest, walk_.nearest), select(counts, next.cosine, walk_.cosine)};
    solid_angle_ = K().solid_angle_add_edge(solid_angle_, a, b);
  }
  Part<S> finish(Mask<S> reversed) {
    const Real<S> solid_angle = K().solid_angle_finish(solid_angle_, reversed);
    Real<S> lobe = K().representative_radiance(walk_, view_, mirror_, solid_angle, alpha_, reversed);
    const Real<S> v_dot_h = K().representative_v_dot_h(walk_, view_, mirror_, reversed);
    if (widening_ == Widening::published) {
      const Real<S> half_radius = sqrt(solid_angle * Real<S>(0.0795774715459476679));  // over the distance
      const Real<S> ours = alpha_ + half_radius / sqrt(max(v_dot_h, Real<S>(1e-6))), theirs = min(alpha_ + half_radius, Real<S>(1.0));
      lobe = lobe * (ours * ours) / (theirs * theirs);
    }
    return {lobe, lobe * K().fresnel_schlick(0.0, 1.0, v_dot_h)};
  }

  // Every point of a small light represents it.
  Real<S> least_distance2() const { return K().light_elements_transformed().least_distance2; }
  SmallLight<S> small_light(const vec3&) const {
    return {K().light_elements_half_vector_sharpness(Real<S>(0.5) * alpha_, view_.z), K().light_elements_transformed()};
  }
  Part<S> at(const vec3& u) const { return K().ggx_lobe_and_fresnel(K().ggx_view(view_, alpha_, alpha_), u, 1.0); }

 private:
  Real<S> alpha_;
  Widening widening_;
  vec3 view_, mirror_;
  typename K::RepresentativeWalk walk_;
  typename K::SolidAngleWalk solid_angle_;
};

}  // namespace integrals
STERADIAN_END_ISA
