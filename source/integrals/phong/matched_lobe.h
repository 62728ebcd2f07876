// The product of two Phong lobes as one lobe of the product's place, height and curvature: an approximation.
//
// The one lobe is not round. A linear map makes it round, and polygons stay polygons: the moment of the stretched outline, by the cosine
// series, is the integral (kernels/lobe/lobe_product.glsl).
#pragma once

#include <optional>

#include "integrals/phong/phong.h"

STERADIAN_BEGIN_ISA
namespace integrals {

// x: radiance of albedo 1, in [0, 1]. 0 for axes 90 degrees apart and more, where the product is about 0. It serves one point at a time,
// since the matched exponent depends on the point.
template <class S>
class MatchedLobe {
 public:
  static constexpr Clip kClip = Clip::horizon;
  using K = Kernels<S>;
  using vec3 = typename K::vec3;

  // axis: axis of the second lobe, unit, in the shading frame.
  MatchedLobe(double exponent, double axis_exponent, const vec3& axis, Quality quality)
      : n1_(exponent),
        n2_(axis_exponent),
        small_(small_light_of_power<S>(exponent + axis_exponent, Kernels<double>().light_elements_series_bias())),
        bends_(exponent < 2 || axis_exponent < 2),
        axis_(axis),
        peaked_(exponent + axis_exponent > 0),
        quality_(quality) {}

  Mask<S> begin(const Shading<S>& shading) {
    K k;
    mirror_ = k.phong_mirror(shading.view);
    auto product = k.lobe_product_begin(peaked_ ? k.lobe_product_peak_of_two(mirror_, n1_, axis_, n2_) : mirror_);
    product = k.lobe_product_add(k.lobe_product_add(product, mirror_, n1_), axis_, n2_);
    lobe_ = k.lobe_product_anisotropic(product);
    round_.emplace(static_cast<double>(lobe_.exponent.v));
    sum_ = 0.0;
    return shading.lit && shading.view.z > Real<S>(0.0);
  }
  vec3 end(const vec3& u) const { return u; }
  void add(const vec3& a, const vec3& b) {
    const vec3 p = stretched(a), q = stretched(b), z(0.0, 0.0, 1.0);
    sum_ += quality_ == Quality::high ? round_->template share<Method::series, Quality::high>(p, q, z)
                                      : round_->template share<Method::series, Quality::normal>(p, q, z);
  }
  Part<S> finish(Mask<S> reversed) {
    // The factor belongs to n1 + n2; the moment's factor belongs to the matched exponent.
    const Real<S> scale = lobe_.scale * ((n1_ + n2_ + 1.0) / (lobe_.exponent + 1.0));
    return {scale * K().moment_phong_radiance(sum_, reversed), Real<S>(0.0)};
  }

  // Small lights use the product itself, without the bias of the one lobe.
  Real<S> least_distance2() const { return small_.limits.least_distance2; }
  SmallLight<S> small_light(const vec3&) const {
    auto small = small_;
    if (bends_) small.limits.bias = 0.0;
    return small;
  }
  Part<S> at(const vec3& u) const {
    K k;
    const Real<S> zero(0.0), c1 = dot(u, mirror_), c2 = dot(u, axis_);
    const Real<S> product = k.phong_power(max(c1, zero), n1_) * k.phong_power(max(c2, zero), n2_);
    return {select(c1 > zero && c2 > zero, (n1_ + n2_ + 1.0) * k.inverse_two_pi() * product, zero), zero};
  }

 private:
  vec3 stretched(const vec3& u) const {
    K k;
    return k.polygon_direction(k.lobe_product_stretch(lobe_, u));
  }

  Real<S> n1_, n2_;
  SmallLight<S> small_;
  bool bends_;  // where a factor ends
  vec3 axis_, mirror_;
  bool peaked_;
  Quality quality_;
  typename K::StretchedLobe lobe_;
  std::optional<PhongLobe<S>> round_;
  Real<S> sum_{0.0};
};

}  // namespace integrals
STERADIAN_END_ISA
