#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/samplers.h"
#include "steradian/kernels.h"

namespace steradian::lobes {
namespace {

Kernels<double> kernels;  // has no state
Kernels<double>::vec3 kernel_vector(Vec3d v) { return {v.x, v.y, v.z}; }

}  // namespace

Vec3d sample_blinn_phong_half_vector(double n, double u, double v) { return sample_cosine_power(n + 1, u, v); }

double pdf_blinn_phong_half_vector(double n, Vec3d h) {
  return h.z > 0 ? kernels.blinn_phong_distribution(kernel_vector(h), n).v * h.z : 0;
}

// The slopes of Beckmann's surface are normally distributed.
Vec3d sample_beckmann_half_vector(double ax, double ay, double u, double v) {
  const double radius = std::sqrt(-std::log1p(-v)), phi = 2 * std::numbers::pi * u;
  return normalized(Vec3d{ax * radius * std::cos(phi), ay * radius * std::sin(phi), 1});
}

double pdf_beckmann_half_vector(double ax, double ay, Vec3d h) {
  return h.z > 0 ? kernels.beckmann_distribution(kernel_vector(h), ax, ay).v * h.z : 0;
}

Vec3d sample_ggx_visible_normal(Vec3d view, double ax, double ay, double u, double v) {
  const Vec3d w = normalized(Vec3d{ax * view.x, ay * view.y, view.z});
  // Reflections at a hemisphere of mirrors fill a cap of the sphere uniformly, from z = -w_z upwards.
  const double z = (1 - v) * (1 + w.z) - w.z;
  const Vec3d cap = direction_at(z, std::sqrt(std::clamp(1 - z * z, 0.0, 1.0)), u);
  const Vec3d h = cap + w;
  return normalized(Vec3d{ax * h.x, ay * h.y, std::max(h.z, 0.0)});
}

double pdf_ggx_visible_normal(Vec3d view, double ax, double ay, Vec3d h) {
  const double v_dot_h = dot(view, h);
  if (!(h.z > 0) || !(v_dot_h > 0)) return 0;
  // G1 / v_z = 2 / (v_z + stretched length)
  const double stretched = kernels.ggx_stretched_length(kernel_vector(view), ax, ay).v;
  return kernels.ggx_distribution(kernel_vector(h), ax, ay).v * v_dot_h * 2 / (view.z + stretched);
}

Vec3d sample_reflection(Vec3d view, Vec3d h) {
  const double v_dot_h = dot(view, h);
  if (!(v_dot_h > 0)) return {};
  return normalized(h * (2 * v_dot_h) - view);
}

double pdf_reflection(Vec3d view, Vec3d h, double half_vector_pdf) {
  const double v_dot_h = dot(view, h);
  return v_dot_h > 0 ? half_vector_pdf / (4 * v_dot_h) : 0;
}

}  // namespace steradian::lobes
