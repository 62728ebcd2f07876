// The product of two and more Phong lobes: a power of the cosine about the mirrored view times powers about axes of the surface.
//
//   (n1 + n2 + ... + 1)/(2 pi) max(l.r, 0)^n1 max(l.a, 0)^n2 ...
//
// There is no foreshortening. With equal axes the product is a Phong lobe of the exponents' sum, which the factor normalises. The further
// apart the axes are, the less remains.
#pragma once

#include <vector>

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian::lobes {

// A factor of the product in the numbers of a kernel.
template <class S>
struct ProductFactor {
  typename Kernels<S>::vec3 axis;
  Real<S> exponent;
};

// The product's sums about a direction.
template <class S>
typename Kernels<S>::LobeProduct product_about(const typename Kernels<S>::vec3& direction, const std::vector<ProductFactor<S>>& factors) {
  Kernels<S> k;
  auto product = k.lobe_product_begin(direction);
  for (const ProductFactor<S>& f : factors) product = k.lobe_product_add(product, f.axis, f.exponent);
  return product;
}

// The direction of the product's maximum: in closed form for two factors, by Newton's steps from the mean axis for more. Without an
// exponent the first axis.
template <class S>
typename Kernels<S>::vec3 product_peak(const std::vector<ProductFactor<S>>& factors) {
  Kernels<S> k;
  Real<S> total(0.0);
  typename Kernels<S>::vec3 mean(0.0, 0.0, 0.0);
  for (const ProductFactor<S>& f : factors) {
    total = total + f.exponent;
    mean = mean + f.axis * f.exponent;
  }
  const Real<S> square = dot(mean, mean);
  if (!any_lane(total > Real<S>(0.0)) || !any_lane(square > Real<S>(1e-12))) return factors.front().axis;
  if (factors.size() == 2) return k.lobe_product_peak_of_two(factors[0].axis, factors[0].exponent, factors[1].axis, factors[1].exponent);
  constexpr int kSteps = 4;  // three leave 2e-7 degrees for lobes within 50 degrees (LobeProduct.NewtonFindsThePeak)
  auto peak = mean * (Real<S>(1.0) / sqrt(square));
  for (int i = 0; i < kSteps; ++i) peak = k.lobe_product_newton(product_about<S>(peak, factors));
  return peak;
}

struct LobeProduct {
  static constexpr Brdf kBrdf = Brdf::lobe_product;
  static constexpr const char* kName = "lobe-product";
  static constexpr Key kKeys[] = {
      kExponent,
      {"axis_exponent", KeyKind::not_negative, [](Draft& d, const KeyValue& v) { d.material.axis_exponent = v.number; }, true},
      {"axis", KeyKind::direction, [](Draft& d, const KeyValue& v) { d.material.axis = v.vector; }},
      {"factors", KeyKind::factors, [](Draft& d, const KeyValue& v) { d.material.factors = v.factors; }},
      kAlbedo};
  static LobeAxis axis_and_width(const Material& m, const ShadingPoint& at) {
    const auto all = factors_of(m, mirrored(at), at.normal);
    return {from_kernel(product_peak(all)), 1 / std::sqrt(sum_of(all) + 1)};
  }

  LobeProduct(const Material& m, Vec3d view)
      : colours{m.albedo},
        factors(factors_of(m, from_kernel(Kernels<double>().phong_mirror(to_kernel(view))), {0, 0, 1})),
        n(sum_of(factors)),
        frame(Frame::from_normal(from_kernel(product_peak(factors)))) {}

  LobeValue evaluate(Vec3d l) const {
    Kernels<double> k;
    double product = 1;
    for (const ProductFactor<double>& f : factors) {
      const double along = dot(l, from_kernel(f.axis));
      if (!(along > 0)) return {};
      product *= k.phong_power(along, f.exponent).v;
    }
    return {(n + 1) / (2 * std::numbers::pi) * product, 0};
  }

  // Samples the power of the exponents' sum about the product's peak, which bounds the product: the arithmetic mean is above the geometric
  // one.
  Vec3d sample(double u, double v) const { return frame.to_world(sample_cosine_power(n, u, v)); }
  double pdf(Vec3d l) const { return pdf_cosine_power(n, dot(l, frame.z)); }

  LobeShape shape() const { return shape_about(frame.z, 1 / std::sqrt(n + 1)); }
  double sensitivity() const { return 1 + n; }
  // At the planes of further factors the quadrature subdivides.
  std::array<Vec3d, 2> ending_planes() const { return {from_kernel(factors[0].axis), from_kernel(factors[1].axis)}; }

  Colours colours;
  std::vector<ProductFactor<double>> factors;
  double n;     // sum of the exponents
  Frame frame;  // about the peak

 private:
  static std::vector<ProductFactor<double>> factors_of(const Material& m, Vec3d mirror, Vec3d normal) {
    std::vector<ProductFactor<double>> all = {{to_kernel(mirror), m.exponent},
                                              {to_kernel(m.axis == Vec3d{} ? normal : normalized(m.axis)), m.axis_exponent}};
    for (const AxisPower& f : m.factors) all.push_back({to_kernel(normalized(f.axis)), f.exponent});
    return all;
  }
  static double sum_of(const std::vector<ProductFactor<double>>& all) {
    double sum = 0;
    for (const ProductFactor<double>& f : all) sum += f.exponent.v;
    return sum;
  }
};

}  // namespace steradian::lobes
