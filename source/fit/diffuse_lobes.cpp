// Broad lobes: Charlie sheen, Disney diffuse, Oren-Nayar.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lobes/charlie.h"
#include "lobes/cosine_sampler.h"
#include "fit/lobe.h"

namespace steradian::fit {
namespace {}  // namespace

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

}  // namespace steradian::fit
