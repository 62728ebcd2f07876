// Published substitutes for the integral of a Phong lobe over a polygon: spherical Gaussians and a representative point. Also the paper's
// peak fits with the half width from a table.
#pragma once

#include <string>
#include <vector>

#include "steradian/phong.h"

namespace steradian::moment {

// Replaces the light by one spherical Gaussian with its solid angle and its mean direction; the length of the mean gives the sharpness. The
// lobe is another Gaussian, exp(n (u.r - 1)). Their product has a closed integral. Source: Wang et al. 2009 for such lights.
double by_spherical_gaussian(const PreparedPolygon& light, const ShadingPoint& at, double n);

// Replaces the light by a Gaussian of its solid angle, mean and covariance in the plane that touches the sphere at its mean direction. The
// lobe is a round Gaussian of variance 1/n. Source: after Xu et al. 2013, "Anisotropic spherical Gaussians".
double by_anisotropic_gaussian(const PreparedPolygon& light, const ShadingPoint& at, double n);

// Replaces the light by a point light in the middle of the intersection of the light and a cone about the mirrored view. The point light
// has the intersection's solid angle. The cone has the solid angle 2 pi/(n + 1), so that a light which fills it sends its radiance. Source:
// Drobot, "Physically based area lights", GPU Pro 5, 2014, section on specular integrals.
double by_representative_point(const PreparedPolygon& light, const ShadingPoint& at, double n);

// The peak fits, each in its better variant, with x_w from a table instead of its fit. The table of 64 cosines by 32 exponents holds the
// true half widths; the paper mentions this variant. method: lorentzian, pearson or ellipsoid.
double by_peak_fit_with_table(Method method, const PreparedPolygon& light, const ShadingPoint& at, double n);

struct Baseline {
  std::string name;
  double (*radiance)(const PreparedPolygon& light, const ShadingPoint& at, double n);  // for a light of radiance 1 above the horizon
};
const std::vector<Baseline>& phong_baselines();

}  // namespace steradian::moment
