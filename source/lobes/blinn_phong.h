// Blinn-Phong: a power of the half vector's cosine, as a microfacet lobe without shadowing and Fresnel.
#pragma once

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian::lobes {

struct BlinnPhong {
  static constexpr Brdf kBrdf = Brdf::blinn_phong;
  static constexpr const char* kName = "blinn-phong";
  static constexpr Key kKeys[] = {kExponent};
  // Turning the half vector turns the reflected direction by twice the angle.
  static LobeAxis axis_and_width(const Material& m, const ShadingPoint& at) { return {mirrored(at), 2 / std::sqrt(m.exponent + 1)}; }

  BlinnPhong(const Material& material, Vec3d view_) : n(material.exponent), view(view_) {}

  LobeValue evaluate(Vec3d l) const {
    return {unshadowed_lobe(Kernels<double>().blinn_phong_distribution(half_vector(l, view), n), l, view), 0};
  }
  Vec3d sample(double u, double v) const { return sample_reflection(view, sample_blinn_phong_half_vector(n, u, v)); }
  double pdf(Vec3d l) const {
    const Vec3d h = normalized(l + view);
    return pdf_reflection(view, h, pdf_blinn_phong_half_vector(n, h));
  }
  LobeShape shape() const {
    const double alpha = std::sqrt(2 / (n + 2));
    return shape_of_half_vectors(view, alpha, alpha, false);
  }
  // log h_z changes by the rounding of h_z, which grows with the length of l + v >= 2 v_z.
  double sensitivity() const { return 1 + n / std::max(view.z, 1e-6); }
  std::array<Vec3d, 2> ending_planes() const { return no_planes(); }

  Colours colours;
  double n;
  Vec3d view;
};

}  // namespace steradian::lobes
