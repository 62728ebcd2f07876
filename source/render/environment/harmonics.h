// Irradiance from a map of directions, by spherical harmonics: the cosine of a surface passes little of the map's detail.
#pragma once

#include <array>

#include "render/environment/direction_grid.h"

namespace steradian::environment {

class HarmonicIrradiance {
 public:
  static constexpr int kDegree = 8;  // odd degrees above 1 are none of the cosine's, so the first that is left out is 10

  explicit HarmonicIrradiance(const DirectionGrid& grid);

  // Irradiance of a surface with that unit normal, all that lies above its horizon; not negative.
  Vec3d at(Vec3d normal) const;

  // What the degrees above leave out: rms over 256 normals of the difference from the sum over the map's texels, luminance, over the mean
  // irradiance; 0 for a black map. Of one point of light it would be 3 %.
  double residual() const { return residual_; }

 private:
  Vec3d sum_at(Vec3d normal) const;

  static constexpr int kCount = (kDegree + 1) * (kDegree + 1);
  std::array<Vec3d, kCount> coefficients_{};  // of the irradiance
  double residual_ = 0;
};

// Values of the real, orthonormal harmonics up to HarmonicIrradiance::kDegree about the y axis, degree l's from index l * l on.
std::array<double, 81> harmonics_at(Vec3d direction);

// Coefficient of degree l of max(cosine, 0) about its axis, as it multiplies those of the radiance: pi, 2 pi / 3, pi / 4, 0, -pi / 24 ...
// Source: Ramamoorthi, Hanrahan, "An efficient representation for irradiance environment maps", 2001, equation 8.
double cosine_coefficient(int degree);

}  // namespace steradian::environment
