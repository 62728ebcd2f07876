// GGX: isotropic or anisotropic, with Smith's height-correlated shadowing or none, and Schlick's Fresnel.
#pragma once

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"
#include "steradian/albedo.h"

namespace steradian::lobes {

struct Ggx {
  static constexpr Brdf kBrdf = Brdf::ggx;
  static constexpr const char* kName = "ggx";
  static constexpr Key kKeys[] = {
      kRoughness,
      kAlpha,
      kAlphaX,
      kAlphaY,
      kTangent,
      {"f0", KeyKind::colour, [](Draft& d, const KeyValue& v) { d.material.f0 = v.vector; }},
      {"f90", KeyKind::colour, [](Draft& d, const KeyValue& v) { d.material.f90 = v.vector; }},
      {"shadowing", KeyKind::word, [](Draft& d, const KeyValue& v) { d.material.shadowing = v.word != "none"; }, false, "smith none"},
      {"multiple_scattering", KeyKind::flag, [](Draft& d, const KeyValue& v) { d.material.multiple_scattering = v.flag; }}};
  static LobeAxis axis_and_width(const Material& m, const ShadingPoint& at) { return {mirrored(at), 2 * std::max(m.alpha_x, m.alpha_y)}; }

  Ggx(const Material& material, Vec3d view_) : ax(material.alpha_x), ay(material.alpha_y), shadowing(material.shadowing), view(view_) {
    Material local = material;
    local.tangent = {1, 0, 0};
    const Material lobe = with_multiple_scattering(local, {{}, {0, 0, 1}, view});
    colours = {lobe.f0, lobe.f90 - lobe.f0};
  }

  LobeValue evaluate(Vec3d l) const {
    Kernels<double> k;
    const auto h = half_vector(l, view);
    const auto d = k.ggx_distribution(h, ax, ay);
    const auto g = shadowing ? k.ggx_shadowing(to_kernel(l), to_kernel(view), ax, ay) : decltype(d)(1.0);
    const double plain = unshadowed_lobe(d * g, l, view);
    return {plain, plain * k.fresnel_schlick(0.0, 1.0, dot(to_kernel(view), h)).v};
  }
  Vec3d sample(double u, double v) const { return sample_reflection(view, sample_ggx_visible_normal(view, ax, ay, u, v)); }
  double pdf(Vec3d l) const {
    const Vec3d h = normalized(l + view);
    return pdf_reflection(view, h, pdf_ggx_visible_normal(view, ax, ay, h));
  }
  LobeShape shape() const { return shape_of_half_vectors(view, ax, ay, true); }
  double sensitivity() const { return 1 + 4 / (std::min({ax, ay, 1.0}) * std::max(view.z, 1e-6)); }
  std::array<Vec3d, 2> ending_planes() const { return no_planes(); }

  Colours colours;
  double ax, ay;
  bool shadowing;
  Vec3d view;
};

}  // namespace steradian::lobes
