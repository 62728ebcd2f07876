// Charlie: the sheen of cloth, glTF's KHR_materials_sheen.
#pragma once

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian::lobes {

// BRDF times the light's cosine for a colour of 1, with the shadowing of its authors. alpha in (0, 1] is the roughness squared, clamped to
// at least kSmoothestCharlie: below, the model reflects more than arrives and only within a few degrees of the horizon. 0 if light or view
// is not above the surface.
// Source: Estevez, Kulla, "Production friendly microfacet sheen BRDF", 2017, eq. 2 to 4 and table 1.
inline constexpr double kSmoothestCharlie = 0.04;
double charlie_lobe(double alpha, Vec3d view, Vec3d light);

struct Charlie {
  static constexpr Brdf kBrdf = Brdf::charlie;
  static constexpr const char* kName = "charlie";
  static constexpr Key kKeys[] = {kAlpha, kRoughness, kAlbedo};
  static LobeAxis axis_and_width(const Material&, const ShadingPoint& at) { return {at.normal, 1}; }

  Charlie(const Material& material, Vec3d view_) : colours{material.albedo}, alpha(material.alpha_x), view(view_) {}

  LobeValue evaluate(Vec3d l) const { return {charlie_lobe(alpha, view, l), 0}; }
  // Uniform over the hemisphere: the lobe is strongest along the horizon, where a cosine density has no samples.
  Vec3d sample(double u, double v) const { return sample_cosine_power(0, u, v); }
  double pdf(Vec3d l) const { return pdf_cosine_power(0, l.z); }
  LobeShape shape() const { return shape_about_normal(); }
  // A power of the half vector's sine; its rounding grows with the length of l + v >= 2 v_z.
  double sensitivity() const { return 1 + 1 / (std::max(alpha, kSmoothestCharlie) * std::max(view.z, 1e-6)); }
  std::array<Vec3d, 2> ending_planes() const { return no_planes(); }

  Colours colours;
  double alpha;
  Vec3d view;
};

}  // namespace steradian::lobes
