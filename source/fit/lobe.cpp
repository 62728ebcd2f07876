#include "fit/lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/charlie.h"
#include "lobes/lobe.h"
#include "lobes/samplers.h"
#include "steradian/error.h"
#include "steradian/kernels.h"

namespace steradian::fit {

Lobe with_grazing_fresnel(const Lobe& lobe) {
  Lobe result = lobe;
  result.evaluate = [lobe](Vec3d l) {
    const double f = lobe.evaluate(l);
    if (f <= 0) return 0.0;
    const double v_dot_h = dot(lobe.view, normalized(l + lobe.view));
    return f * std::pow(std::clamp(1 - v_dot_h, 0.0, 1.0), 5.0);
  };
  return result;
}

Lobe with_samples(Lobe lobe) {
  if (lobe.sample) return lobe;
  lobe.sample = [](double a, double b) { return lobes::sample_cosine_hemisphere(b, a); };
  lobe.pdf = lobes::pdf_cosine_hemisphere;
  return lobe;
}

const std::vector<LobeFamily>& lobe_families() {
  const auto by_alpha = [](Lobe (*lobe)(double, Vec3d)) {
    return [lobe](double roughness, double cos_theta) { return lobe(alpha_from_roughness(roughness), view_from_cosine(cos_theta)); };
  };
  static const std::vector<LobeFamily> families = {
      {"ggx", LobeFrame::mirror, by_alpha(ggx_lobe)},
      {"beckmann", LobeFrame::mirror, by_alpha(beckmann_lobe)},
      {"charlie", LobeFrame::normal, by_alpha(charlie_lobe)},
      {"disney-diffuse", LobeFrame::normal,
       [](double roughness, double cos_theta) { return disney_diffuse_lobe(roughness, view_from_cosine(cos_theta)); }},
      {"oren-nayar", LobeFrame::normal,
       [](double roughness, double cos_theta) { return oren_nayar_lobe(roughness * 0.5 * std::numbers::pi, view_from_cosine(cos_theta)); }},
  };
  return families;
}

const LobeFamily& lobe_family(const std::string& name) {
  std::string known;
  for (const LobeFamily& family : lobe_families()) {
    if (family.name == name) return family;
    known += (known.empty() ? "" : ", ") + family.name;
  }
  throw Error("--lobe", "unknown lobe '" + name + "'", "one of " + known);
}

// Broad lobes: Charlie sheen, Disney diffuse, Oren-Nayar.

Lobe charlie_lobe(double alpha, Vec3d v) {
  Lobe lobe;
  lobe.view = v;
  lobe.evaluate = [=](Vec3d l) { return lobes::charlie_lobe(alpha, v, l); };
  // Uniform over the hemisphere: the lobe is strongest along the horizon, where a cosine density has no samples.
  lobe.sample = [](double a, double b) { return lobes::direction_at(1 - a, std::sqrt(std::max(1 - (1 - a) * (1 - a), 0.0)), b); };
  lobe.pdf = [](Vec3d l) { return l.z >= 0 ? 0.5 / std::numbers::pi : 0.0; };
  return lobe;
}

// Source: Burley, "Physically based shading at Disney", 2012, section 5.3.
Lobe disney_diffuse_lobe(double roughness, Vec3d v) {
  const auto fifth = [](double c) { return std::pow(std::clamp(1 - c, 0.0, 1.0), 5.0); };
  Lobe lobe;
  lobe.view = v;
  lobe.evaluate = [=](Vec3d l) {
    if (l.z <= 0) return 0.0;
    const double l_dot_h = dot(l, normalized(l + v));
    const double excess = 2 * roughness * l_dot_h * l_dot_h - 0.5;
    return l.z / std::numbers::pi * (1 + excess * fifth(l.z)) * (1 + excess * fifth(v.z));
  };
  return with_samples(lobe);
}

// Source: Oren, Nayar, "Generalization of Lambert's reflectance model", 1994, eq. 30 and 31 with albedo 1.
Lobe oren_nayar_lobe(double sigma, Vec3d v) {
  const double s2 = sigma * sigma;
  const double c1 = 1 - 0.5 * s2 / (s2 + 0.33);
  Lobe lobe;
  lobe.view = v;
  lobe.evaluate = [=](Vec3d l) {
    if (l.z <= 0) return 0.0;
    const double sine = std::sqrt(std::max(1 - l.z * l.z, 0.0));
    const double cos_phi = sine > 0 && v.x > 0 ? std::clamp(l.x / sine, -1.0, 1.0) : 0.0;
    const double theta_l = std::acos(std::min(l.z, 1.0)), theta_v = std::acos(std::min(v.z, 1.0));
    const double larger = std::max(theta_l, theta_v), smaller = std::min(theta_l, theta_v);
    const double c2 =
        0.45 * s2 / (s2 + 0.09) * (cos_phi >= 0 ? std::sin(larger) : std::sin(larger) - std::pow(2 * smaller / std::numbers::pi, 3.0));
    const double c3 = 0.125 * s2 / (s2 + 0.09) * std::pow(4 * larger * smaller / (std::numbers::pi * std::numbers::pi), 2.0);
    const double direct = c1 + c2 * cos_phi * std::tan(smaller) + c3 * (1 - std::fabs(cos_phi)) * std::tan(0.5 * (larger + smaller));
    const double bounce = 0.17 * s2 / (s2 + 0.13) * (1 - cos_phi * std::pow(2 * smaller / std::numbers::pi, 2.0));
    return l.z / std::numbers::pi * std::max(direct + bounce, 0.0);
  };
  return with_samples(lobe);
}

// GGX and Beckmann: half vectors are drawn from the distribution, and the view is mirrored about them.

namespace {

Vec3<Real<double>> to_kernel(Vec3d v) { return {v.x, v.y, v.z}; }

}  // namespace

Lobe ggx_lobe_anisotropic(double ax, double ay, Vec3d v) {
  Material material;
  material.brdf = Brdf::ggx;
  material.alpha_x = ax;
  material.alpha_y = ay;
  const lobes::Lobe ggx(material, v);
  Lobe lobe;
  lobe.view = v;
  lobe.evaluate = [=](Vec3d l) { return ggx.evaluate(l).plain; };
  lobe.sample = [=](double a, double b) { return ggx.sample(b, a); };
  lobe.pdf = [=](Vec3d l) { return ggx.pdf(l); };
  return lobe;
}

Lobe ggx_lobe(double alpha, Vec3d view) { return ggx_lobe_anisotropic(alpha, alpha, view); }

Lobe beckmann_lobe(double alpha, Vec3d v) {
  // Smith's Lambda of Beckmann: (erf(a) - 1)/2 + exp(-a^2)/(2 a sqrt(pi)), a = 1/(alpha tan). Heitz 2014, eq. 86.
  const auto lambda = [alpha](double z) {
    const double t = std::sqrt(std::max(1 - z * z, 0.0)) / z;
    if (alpha * t < 1e-9) return 0.0;
    const double a = 1 / (alpha * t);
    return -0.5 * std::erfc(a) + std::exp(-a * a) / (2 * a * std::sqrt(std::numbers::pi));
  };
  const double lambda_v = lambda(v.z);
  Lobe lobe;
  lobe.view = v;
  lobe.evaluate = [=](Vec3d l) {
    if (l.z <= 0) return 0.0;
    const double d = Kernels<double>{}.beckmann_distribution(to_kernel(normalized(l + v)), alpha, alpha).v;
    return d / (4 * v.z * (1 + lambda_v + lambda(l.z)));
  };
  lobe.sample = [=](double a, double b) { return lobes::sample_reflection(v, lobes::sample_beckmann_half_vector(alpha, alpha, b, a)); };
  lobe.pdf = [=](Vec3d l) {
    const Vec3d h = normalized(l + v);
    return lobes::pdf_reflection(v, h, lobes::pdf_beckmann_half_vector(alpha, alpha, h));
  };
  return lobe;
}

}  // namespace steradian::fit
