// Beckmann: a Gaussian of slopes, as a microfacet lobe without shadowing and Fresnel; isotropic or anisotropic.
#pragma once

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian::lobes {

struct Beckmann {
  static constexpr Brdf kBrdf = Brdf::beckmann;
  static constexpr const char* kName = "beckmann";
  static constexpr Key kKeys[] = {kAlpha, kRoughness, kAlphaX, kAlphaY, kTangent};
  static LobeAxis axis_and_width(const Material& m, const ShadingPoint& at) { return {mirrored(at), 2 * std::max(m.alpha_x, m.alpha_y)}; }

  Beckmann(const Material& material, Vec3d view_) : ax(material.alpha_x), ay(material.alpha_y), view(view_) {}

  LobeValue evaluate(Vec3d l) const {
    return {unshadowed_lobe(Kernels<double>().beckmann_distribution(half_vector(l, view), ax, ay), l, view), 0};
  }
  Vec3d sample(double u, double v) const { return sample_reflection(view, sample_beckmann_half_vector(ax, ay, u, v)); }
  double pdf(Vec3d l) const {
    const Vec3d h = normalized(l + view);
    return pdf_reflection(view, h, pdf_beckmann_half_vector(ax, ay, h));
  }
  LobeShape shape() const { return shape_of_half_vectors(view, ax, ay, false); }
  double sensitivity() const { return 1 + 4 / (std::min({ax, ay, 1.0}) * std::max(view.z, 1e-6)); }
  std::array<Vec3d, 2> ending_planes() const { return no_planes(); }

  Colours colours;
  double ax, ay;
  Vec3d view;
};

}  // namespace steradian::lobes
