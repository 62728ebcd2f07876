#include "reference/lobe.h"

#include <algorithm>
#include <cmath>

#include "reference/charlie.h"
#include "reference/half_vector_sampler.h"
#include "reference/cosine_sampler.h"
#include "steradian/albedo.h"
#include "steradian/kernels.h"

namespace steradian::reference {
namespace {

Kernels<double> kernels;  // has no state
using KernelVec3 = Kernels<double>::vec3;

KernelVec3 to_kernel(Vec3d v) { return {v.x, v.y, v.z}; }
Vec3d from_kernel(KernelVec3 v) { return {v.x.v, v.y.v, v.z.v}; }

double largest_component(Vec3d v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

}  // namespace

Lobe::Lobe(const Material& material, Vec3d view)
    : brdf_(material.brdf),
      view_(view),
      n_(material.exponent),
      ax_(material.alpha_x),
      ay_(material.alpha_y),
      shadowing_(material.shadowing),
      mirror_(from_kernel(kernels.phong_mirror(to_kernel(view)))),
      mirror_frame_(Frame::from_normal(mirror_)) {
  switch (brdf_) {
    case Brdf::lambert:
    case Brdf::phong:
    case Brdf::charlie: plain_ = material.albedo; break;
    case Brdf::ggx: {
      Material local = material;
      local.tangent = {1, 0, 0};
      const Material lobe = with_multiple_scattering(local, {{}, {0, 0, 1}, view});
      plain_ = lobe.f0;
      fresnel_ = lobe.f90 - lobe.f0;
      break;
    }
    case Brdf::blinn_phong:
    case Brdf::beckmann: plain_ = {1, 1, 1}; break;
  }
}

LobeValue Lobe::evaluate(Vec3d light) const {
  if (!(light.z > 0) || !above_surface()) return {};
  const KernelVec3 l = to_kernel(light), v = to_kernel(view_);
  switch (brdf_) {
    case Brdf::lambert: return {kernels.lambert_lobe(l).v, 0};
    case Brdf::phong:
      if (!(dot(light, mirror_) > 0)) return {};  // the kernel's power 0 knows no end of the lobe
      return {kernels.phong_lobe(l, to_kernel(mirror_), n_).v, 0};
    case Brdf::charlie: return {charlie_lobe(ax_, view_, light), 0};
    default: break;
  }
  const KernelVec3 h = kernels.microfacet_half_vector(l, v);
  if (brdf_ == Brdf::blinn_phong)
    return {kernels.microfacet_lobe_unshadowed(kernels.blinn_phong_distribution(h, n_), l, v).v, 0};
  if (brdf_ == Brdf::beckmann)
    return {kernels.microfacet_lobe_unshadowed(kernels.beckmann_distribution(h, ax_, ay_), l, v).v, 0};
  const auto d = kernels.ggx_distribution(h, ax_, ay_);
  const auto g = shadowing_ ? kernels.ggx_shadowing(l, v, ax_, ay_) : decltype(d)(1.0);
  const double plain = kernels.microfacet_lobe_unshadowed(d * g, l, v).v;
  return {plain, plain * kernels.fresnel_schlick(0.0, 1.0, dot(v, h)).v};
}

Vec3d Lobe::sample(double u, double v) const {
  switch (brdf_) {
    case Brdf::lambert: return sample_cosine_hemisphere(u, v);
    case Brdf::phong: return mirror_frame_.to_world(sample_cosine_power(n_, u, v));
    case Brdf::blinn_phong: return sample_reflection(view_, sample_blinn_phong_half_vector(n_, u, v));
    case Brdf::beckmann: return sample_reflection(view_, sample_beckmann_half_vector(ax_, ay_, u, v));
    case Brdf::charlie: return sample_cosine_power(0, u, v);
    case Brdf::ggx: return sample_reflection(view_, sample_ggx_visible_normal(view_, ax_, ay_, u, v));
  }
  return {};
}

double Lobe::pdf(Vec3d l) const {
  if (brdf_ == Brdf::lambert) return pdf_cosine_hemisphere(l);
  if (brdf_ == Brdf::charlie) return pdf_cosine_power(0, l.z);
  if (brdf_ == Brdf::phong) return pdf_cosine_power(n_, dot(l, mirror_));
  const Vec3d h = normalized(l + view_);
  double half_vector_pdf = 0;
  if (brdf_ == Brdf::blinn_phong) half_vector_pdf = pdf_blinn_phong_half_vector(n_, h);
  if (brdf_ == Brdf::beckmann) half_vector_pdf = pdf_beckmann_half_vector(ax_, ay_, h);
  if (brdf_ == Brdf::ggx) half_vector_pdf = pdf_ggx_visible_normal(view_, ax_, ay_, h);
  return pdf_reflection(view_, h, half_vector_pdf);
}

LobeValue Lobe::largest_factors() const { return {largest_component(plain_), largest_component(fresnel_)}; }

LobeShape Lobe::shape() const {
  const Frame& m = mirror_frame_;
  if (brdf_ == Brdf::lambert || brdf_ == Brdf::charlie) return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}, 1.0, false};
  if (brdf_ == Brdf::phong) return {mirror_, m.x, m.y, mirror_, {}, 1 / std::sqrt(n_ + 1), false};
  const double blinn = std::sqrt(2 / (n_ + 2));
  const double ax = brdf_ == Brdf::blinn_phong ? blinn : ax_, ay = brdf_ == Brdf::blinn_phong ? blinn : ay_;
  const double width = std::max(ax, ay);
  return {mirror_, {ax / width, 0, 0}, {0, ay / width, 0}, {0, 0, 1}, view_, std::min(width, 1.0), brdf_ == Brdf::ggx};
}

double Lobe::sensitivity() const {
  switch (brdf_) {
    case Brdf::lambert: return 1;
    case Brdf::phong: return 1 + n_;
    // log h_z moves by the rounding of h_z, which the length of l + v >= 2 v_z enlarges.
    case Brdf::blinn_phong: return 1 + n_ / std::max(view_.z, 1e-6);
    // Its power of the half vector's sine, likewise.
    case Brdf::charlie: return 1 + 1 / (std::max(ax_, kSmoothestCharlie) * std::max(view_.z, 1e-6));
    case Brdf::ggx:
    case Brdf::beckmann: return 1 + 4 / (std::min({ax_, ay_, 1.0}) * std::max(view_.z, 1e-6));
  }
  return 1;
}

Vec3d Lobe::ending_plane() const { return brdf_ == Brdf::phong ? mirror_ : Vec3d{}; }

}  // namespace steradian::reference
