// Irradiance from a map of directions, by spherical harmonics: a surface's cosine passes little of the map's detail.
#pragma once

#include <array>

#include "render/environment/direction_grid.h"

namespace steradian::environment {

class HarmonicIrradiance {
 public:
  static constexpr int kDegree = 8;  // the cosine has no odd degrees above 1, so the first omitted degree is 10

  explicit HarmonicIrradiance(const DirectionGrid& grid);

  // Irradiance of a surface with unit normal `normal` from everything above its horizon; not negative.
  Vec3d at(Vec3d normal) const;

  // Error of omitting the higher degrees: rms over 256 normals of the difference from the sum over the map's texels (luminance). It is
  // relative to the mean irradiance, and 0 for a black map. A single point of light would give 3 %.
  double residual() const { return residual_; }

 private:
  Vec3d sum_at(Vec3d normal) const;

  static constexpr int kCount = (kDegree + 1) * (kDegree + 1);
  std::array<Vec3d, kCount> coefficients_{};  // coefficients of the irradiance
  double residual_ = 0;
};

// Values of the real, orthonormal harmonics about the y axis, up to HarmonicIrradiance::kDegree. Those of degree l start at index l * l.
std::array<double, 81> harmonics_at(Vec3d direction);

// Coefficient of degree l of max(cosine, 0) about its axis, as a factor of the radiance's: pi, 2 pi / 3, pi / 4, 0, -pi / 24 ...
// Source: Ramamoorthi, Hanrahan, "An efficient representation for irradiance environment maps", 2001, equation 8.
double cosine_coefficient(int degree);

}  // namespace steradian::environment
