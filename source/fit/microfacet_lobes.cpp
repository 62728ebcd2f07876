// GGX and Beckmann: half vectors are drawn from the distribution, and the view is mirrored about them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/lobe.h"
#include "fit/lobe.h"
#include "steradian/kernels.h"

namespace steradian::fit {
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
