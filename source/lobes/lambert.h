// Lambert: a lobe of the same radiance in every direction.
#pragma once

#include "lobes/lobe_parts.h"
#include "lobes/samplers.h"

namespace steradian::lobes {

struct Lambert {
  static constexpr Brdf kBrdf = Brdf::lambert;
  static constexpr const char* kName = "lambert";
  static constexpr Key kKeys[] = {kAlbedo};
  static LobeAxis axis_and_width(const Material&, const ShadingPoint& at) { return {mirrored(at), 1}; }

  Lambert(const Material& material, Vec3d view_) : colours{material.albedo, material.albedo * -material.fresnel_loss}, view(view_) {}

  // The loss to the reflection of a dielectric above follows Schlick's Fresnel term.
  LobeValue evaluate(Vec3d l) const {
    const auto plain = Kernels<double>().lambert_lobe(to_kernel(l));
    return {plain.v, (plain * Kernels<double>().lambert_grazing(to_kernel(l), to_kernel(view))).v};
  }
  Vec3d sample(double u, double v) const { return sample_cosine_hemisphere(u, v); }
  double pdf(Vec3d l) const { return pdf_cosine_hemisphere(l); }
  LobeShape shape() const { return shape_about_normal(); }
  double sensitivity() const { return 1; }
  std::array<Vec3d, 2> ending_planes() const { return no_planes(); }

  Colours colours;
  Vec3d view;
};

}  // namespace steradian::lobes
