// The product of two and more Phong lobes as one lobe of the product's place, height and curvature: an approximation.
//
// The one lobe is not round. A linear map makes it round, and polygons stay polygons: the moment of the stretched outline, by the cosine
// series, is the integral (kernels/lobe/lobe_product.glsl).
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "integrals/phong/phong.h"
#include "lobes/lobe_product.h"

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

  using Factor = lobes::ProductFactor<S>;

  // axes: the lobes about axes of the surface, unit, in the shading frame.
  MatchedLobe(double exponent, std::vector<Factor> axes, Quality quality) : factors_(std::move(axes)), quality_(quality) {
    factors_.insert(factors_.begin(), Factor{{}, exponent});
    double sum = 0;
    for (const Factor& f : factors_) {
      sum += static_cast<double>(f.exponent.v);
      bends_ = bends_ || static_cast<double>(f.exponent.v) < 2;
    }
    sum_of_exponents_ = sum;
    small_ = small_light_of_power<S>(sum, Kernels<double>().light_elements_series_bias());
  }

  Mask<S> begin(const Shading<S>& shading) {
    K k;
    factors_.front().axis = k.phong_mirror(shading.view);
    lobe_ = k.lobe_product_anisotropic(lobes::product_about<S>(lobes::product_peak<S>(factors_), factors_));
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
    // The factor belongs to the sum of exponents; the moment's factor belongs to the matched exponent.
    const Real<S> scale = lobe_.scale * ((sum_of_exponents_ + 1.0) / (lobe_.exponent + 1.0));
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
    const Real<S> zero(0.0);
    Real<S> product = (sum_of_exponents_ + 1.0) * k.inverse_two_pi();
    for (const Factor& f : factors_) {
      const Real<S> cosine = dot(u, f.axis);
      product = select(cosine > zero, product * k.phong_power(max(cosine, zero), f.exponent), zero);
    }
    return {product, zero};
  }

 private:
  vec3 stretched(const vec3& u) const {
    K k;
    return k.polygon_direction(k.lobe_product_stretch(lobe_, u));
  }

  std::vector<Factor> factors_;  // the first about the mirrored view
  Real<S> sum_of_exponents_{0.0};
  SmallLight<S> small_{};
  bool bends_ = false;  // where a factor ends
  Quality quality_;
  typename K::StretchedLobe lobe_;
  std::optional<PhongLobe<S>> round_;
  Real<S> sum_{0.0};
};

}  // namespace integrals
STERADIAN_END_ISA
