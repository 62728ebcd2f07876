// What others put in the place of the integral of a Phong lobe over a polygon: spherical Gaussians, a representative point; and the
// paper's peak fits with the half width by a table.
#pragma once

#include <string>
#include <vector>

#include "steradian/phong.h"

namespace steradian::moment {

// The light as one Gaussian on the sphere with its solid angle and its mean direction, as sharp as that mean is long, times the
// lobe as another, exp(n (u.r - 1)): their product has a closed integral. Source: Wang et al. 2009 for such lights.
double by_spherical_gaussian(const PreparedPolygon& light, const ShadingPoint& at, double n);

// The light as a Gaussian of its solid angle, its mean and its covariance in the plane that touches the sphere at its mean direction,
// times the lobe as a round one of variance 1/n. Source: after Xu et al. 2013, "Anisotropic spherical Gaussians".
double by_anisotropic_gaussian(const PreparedPolygon& light, const ShadingPoint& at, double n);

// A point light in the middle of what the light and a cone about the mirrored view have in common, with the solid angle of that
// part. The cone has the solid angle 2 pi/(n + 1), so that a light which fills it sends its radiance.
// Source: Drobot, "Physically based area lights", GPU Pro 5, 2014, section on specular integrals.
double by_representative_point(const PreparedPolygon& light, const ShadingPoint& at, double n);

// The peak fits, each in its better form, with x_w from a table of 64 cosines by 32 exponents that holds the true half widths,
// instead of from its fit: the variant that the paper mentions. method: lorentzian, pearson or ellipsoid.
double by_peak_fit_with_table(Method method, const PreparedPolygon& light, const ShadingPoint& at, double n);

struct Baseline {
  std::string name;
  double (*radiance)(const PreparedPolygon& light, const ShadingPoint& at, double n);  // of a light of radiance 1 above the horizon
};
const std::vector<Baseline>& phong_baselines();

}  // namespace steradian::moment
