// The product of two Phong lobes: a power of the cosine about the mirrored view times one about an axis of the surface.
//
//   (n1 + n2 + 1)/(2 pi) max(l.r, 0)^n1 max(l.a, 0)^n2
//
// There is no foreshortening. With equal axes the product is a Phong lobe of exponent n1 + n2, which the factor normalises. The further
// apart the axes are, the less remains.
#pragma once

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian::lobes {

struct LobeProduct {
  static constexpr Brdf kBrdf = Brdf::lobe_product;
  static constexpr const char* kName = "lobe-product";
  static constexpr Key kKeys[] = {
      kExponent,
      {"axis_exponent", KeyKind::not_negative, [](Draft& d, const KeyValue& v) { d.material.axis_exponent = v.number; }, true},
      {"axis", KeyKind::direction, [](Draft& d, const KeyValue& v) { d.material.axis = v.vector; }},
      kAlbedo};
  static LobeAxis axis_and_width(const Material& m, const ShadingPoint& at) {
    return {peak_of(mirrored(at), m.exponent, axis_of(m, at.normal), m.axis_exponent), width_of(m)};
  }

  LobeProduct(const Material& m, Vec3d view)
      : colours{m.albedo},
        n1(m.exponent),
        n2(m.axis_exponent),
        mirror(from_kernel(Kernels<double>().phong_mirror(to_kernel(view)))),
        axis(axis_of(m, {0, 0, 1})),
        frame(Frame::from_normal(peak_of(mirror, n1, axis, n2))) {}

  LobeValue evaluate(Vec3d l) const {
    const double along_mirror = dot(l, mirror), along_axis = dot(l, axis);
    if (!(along_mirror > 0) || !(along_axis > 0)) return {};
    Kernels<double> k;
    return {(n1 + n2 + 1) / (2 * std::numbers::pi) * (k.phong_power(along_mirror, n1) * k.phong_power(along_axis, n2)).v, 0};
  }

  // Samples the power n1 + n2 about the product's peak, which bounds the product: the arithmetic mean is above the geometric one.
  Vec3d sample(double u, double v) const { return frame.to_world(sample_cosine_power(n1 + n2, u, v)); }
  double pdf(Vec3d l) const { return pdf_cosine_power(n1 + n2, dot(l, frame.z)); }

  LobeShape shape() const { return shape_about(frame.z, 1 / std::sqrt(n1 + n2 + 1)); }
  double sensitivity() const { return 1 + n1 + n2; }
  std::array<Vec3d, 2> ending_planes() const { return {mirror, axis}; }

  Colours colours;
  double n1, n2;
  Vec3d mirror, axis;
  Frame frame;  // about the peak

 private:
  static Vec3d axis_of(const Material& m, Vec3d normal) { return m.axis == Vec3d{} ? normal : normalized(m.axis); }
  static double width_of(const Material& m) { return 1 / std::sqrt(m.exponent + m.axis_exponent + 1); }
  static Vec3d peak_of(Vec3d r1, double n1, Vec3d r2, double n2) {
    if (!(n1 + n2 > 0)) return r1;
    return from_kernel(Kernels<double>().lobe_product_peak_of_two(to_kernel(r1), n1, to_kernel(r2), n2));
  }
};

}  // namespace steradian::lobes
