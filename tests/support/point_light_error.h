// Error of transformed cosines under lights without extent, against GGX itself.
#pragma once

#include <cmath>
#include <numbers>

#include "integrals/point_light.h"
#include "lobes/lobe.h"

namespace steradian::test {

inline constexpr double kPointRoughness[] = {0.1, 0.25, 0.4, 0.55, 0.7, 0.85};
inline constexpr double kPointViews[] = {3, 20, 40, 60, 75, 86};  // degrees from the normal

// Relative RMSE of a method's lobe over directions of the light, of equal solid angle. The directions are samples of the lobe, weighted by
// their density.
inline double error_under_points(const methods::Row& row, Quality quality, double roughness, double view, double f0) {
  constexpr int kDirections = 4096;
  Material m;
  m.brdf = Brdf::ggx;
  m.alpha_x = m.alpha_y = roughness * roughness;
  m.f0 = {f0, f0, f0};
  const double angle = view * std::numbers::pi / 180;
  const ShadingPoint at = {{}, {0, 0, 1}, {std::sin(angle), 0, std::cos(angle)}};
  const lobes::Lobe lobe(m, at.view);
  double errors = 0, signal = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double turn = i * std::numbers::phi;
    const Vec3d l = lobe.sample((i + 0.5) / kDirections, turn - std::floor(turn));
    if (!(l.z > 0)) continue;
    const double truth = lobe.radiance(lobe.evaluate(l)).x, off = methods::lobe_towards(l, at, m, row, {row.method, quality}).x - truth;
    errors += off * off / lobe.pdf(l);
    signal += truth * truth / lobe.pdf(l);
  }
  return std::sqrt(errors / signal);
}

struct PointLightError {
  double rms = 0, worst = 0;  // over pairs of roughness and view
};
inline PointLightError error_under_points(const methods::Row& row, Quality quality, double f0) {
  PointLightError result;
  for (const double roughness : kPointRoughness)
    for (const double view : kPointViews) {
      const double error = error_under_points(row, quality, roughness, view, f0);
      result.rms += error * error / static_cast<double>(std::size(kPointRoughness) * std::size(kPointViews));
      result.worst = std::max(result.worst, error);
    }
  result.rms = std::sqrt(result.rms);
  return result;
}

}  // namespace steradian::test
