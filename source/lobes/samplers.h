// Samplers of lobes: a cosine or a power of it, and half vectors.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/vector.h"

namespace steradian::lobes {

// Sampling of directions with the density of a cosine or of a power of it, about z. u, v in [0, 1).

// The direction at height z and at the fraction u of a full turn.
inline Vec3d direction_at(double z, double sine, double u) {
  const double phi = 2 * std::numbers::pi * u;
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

// Density cos / pi over the hemisphere: a uniform point of the disk, lifted.
inline Vec3d sample_cosine_hemisphere(double u, double v) { return direction_at(std::sqrt(1 - v), std::sqrt(v), u); }
inline double pdf_cosine_hemisphere(Vec3d l) { return std::max(l.z, 0.0) / std::numbers::pi; }

// Density (n+1)/(2 pi) cos^n over the hemisphere, n >= 0: the Phong lobe about its axis.
inline Vec3d sample_cosine_power(double n, double u, double v) {
  const double log_z = std::log1p(-v) / (n + 1);
  // expm1 computes 1 - z^2 accurately: the lobe of a large exponent is narrow.
  return direction_at(std::exp(log_z), std::sqrt(std::max(-std::expm1(2 * log_z), 0.0)), u);
}
inline double pdf_cosine_power(double n, double cosine) {
  if (!(cosine > 0)) return 0;
  return (n + 1) / (2 * std::numbers::pi) * std::pow(cosine, n);
}

// Sampling of half vectors with the density of a microfacet distribution, in the shading frame, and of their reflections.

// Density D(h) h_z over the hemisphere, u, v in [0, 1).
Vec3d sample_blinn_phong_half_vector(double n, double u, double v);
double pdf_blinn_phong_half_vector(double n, Vec3d h);
Vec3d sample_beckmann_half_vector(double ax, double ay, double u, double v);
double pdf_beckmann_half_vector(double ax, double ay, Vec3d h);

// Normals of a GGX surface that are visible from the view: density G1(v) D(h) max(v.h, 0) / v_z. The view is above the surface.
// Source: Dupuy, Benyoub, "Sampling visible GGX normals with spherical caps", 2023, listing 3.
Vec3d sample_ggx_visible_normal(Vec3d view, double ax, double ay, double u, double v);
double pdf_ggx_visible_normal(Vec3d view, double ax, double ay, Vec3d h);

// The view mirrored at h; the zero vector if h looks away from the view.
Vec3d sample_reflection(Vec3d view, Vec3d h);
// Density of the reflection per solid angle: that of h over 4 v.h.
double pdf_reflection(Vec3d view, Vec3d h, double half_vector_pdf);

}  // namespace steradian::lobes
