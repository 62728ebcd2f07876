// GGX and Beckmann: half vectors drawn from the distribution, the view mirrored about them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ltc/lobe.h"
#include "steradian/kernels.h"

namespace steradian {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3<Real<double>> to_kernel(Vec3d v) { return {v.x, v.y, v.z}; }

Vec3d mirrored(Vec3d v, Vec3d h) { return normalized(h * (2 * dot(v, h)) - v); }

double half_vector_pdf_to_light(double pdf_h, double v_dot_h) { return pdf_h / (4 * std::max(std::fabs(v_dot_h), 1e-12)); }

}  // namespace

Lobe ggx_lobe_anisotropic(double ax, double ay, Vec3d v) {
  const Vec3d stretched = normalized(Vec3d{ax * v.x, ay * v.y, v.z});
  Lobe lobe;
  lobe.view = v;
  lobe.evaluate = [=](Vec3d l) { return Kernels<double>{}.ggx_lobe(to_kernel(l), to_kernel(v), ax, ay).v; };
  // Visible normals: the stretched surface is a hemisphere, whose mirror images of v fill a spherical cap evenly.
  // Source: Dupuy, Benyoub, "Sampling visible GGX normals with spherical caps", 2023.
  lobe.sample = [=](double a, double b) {
    const double z = 1 - a * (1 + stretched.z);
    const double s = std::sqrt(std::max(1 - z * z, 0.0));
    const double phi = 2 * kPi * b;
    const Vec3d h = Vec3d{s * std::cos(phi), s * std::sin(phi), z} + stretched;
    return mirrored(v, normalized(Vec3d{ax * h.x, ay * h.y, std::max(h.z, 0.0)}));
  };
  // D(h) G1(v) / (4 v_z): the density of visible normals times the mirror's Jacobian.
  lobe.pdf = [=](Vec3d l) {
    Kernels<double> k;
    const Vec3d h = normalized(l + v);
    if (h.z <= 0) return 0.0;
    const double g1_over_vz = 2 / (v.z + k.ggx_stretched_length(to_kernel(v), ax, ay).v);
    return 0.25 * k.ggx_distribution(to_kernel(h), ax, ay).v * g1_over_vz;
  };
  return lobe;
}

Lobe ggx_lobe(double alpha, Vec3d view) { return ggx_lobe_anisotropic(alpha, alpha, view); }

Lobe beckmann_lobe(double alpha, Vec3d v) {
  // Smith's Lambda of Beckmann: (erf(a) - 1)/2 + exp(-a^2)/(2 a sqrt(pi)), a = 1/(alpha tan). Heitz 2014, eq. 86.
  const auto lambda = [alpha](double z) {
    const double t = std::sqrt(std::max(1 - z * z, 0.0)) / z;
    if (alpha * t < 1e-9) return 0.0;
    const double a = 1 / (alpha * t);
    return -0.5 * std::erfc(a) + std::exp(-a * a) / (2 * a * std::sqrt(kPi));
  };
  const double lambda_v = lambda(v.z);
  Lobe lobe;
  lobe.view = v;
  lobe.evaluate = [=](Vec3d l) {
    if (l.z <= 0) return 0.0;
    const double d = Kernels<double>{}.beckmann_distribution(to_kernel(normalized(l + v)), alpha, alpha).v;
    return d / (4 * v.z * (1 + lambda_v + lambda(l.z)));
  };
  // Normals weighted by their cosine: tan^2 of the polar angle is exponential.
  lobe.sample = [=](double a, double b) {
    const double t = alpha * std::sqrt(-std::log1p(-a));
    const double phi = 2 * kPi * b;
    return mirrored(v, normalized(Vec3d{t * std::cos(phi), t * std::sin(phi), 1}));
  };
  lobe.pdf = [=](Vec3d l) {
    // Facets seen from behind mirror the view too: l has a density from both h and -h, of which one is upward.
    Vec3d h = normalized(l + v);
    if (h.z < 0) h = -h;
    const double d = Kernels<double>{}.beckmann_distribution(to_kernel(h), alpha, alpha).v;
    return half_vector_pdf_to_light(d * h.z, dot(v, h));
  };
  return lobe;
}

}  // namespace steradian
