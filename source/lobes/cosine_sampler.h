// Sampling of directions with the density of a cosine or of a power of it, about z. u, v in [0, 1).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steradian/vector.h"

namespace steradian::lobes {

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

}  // namespace steradian::lobes
