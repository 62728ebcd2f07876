// Test support: error of the weight of a diffuse lobe under a dielectric's boundary against glTF's 1 - F(v.h).
#pragma once

#include <cmath>
#include <numbers>

#include "steradian/kernels.h"
#include "steradian/reference.h"
#include "support/random_squares.h"

namespace steradian::reference {

// Relative errors, root mean square over the lights, of a boundary with F90 = 1 (the factor 1 - F0 cancels).
struct DiffuseBelowErrors {
  double ours = 0;      // lambert_irradiance_below
  double constant = 0;  // the weight 1 - F0 in every direction
};

// The walk of kernels/outline/polygon.glsl, and the result from its irradiance vector.
inline double diffuse_below(const PreparedPolygon& light, const ShadingPoint& at, double loss) {
  Kernels<double> k;
  const Frame frame = Frame::from_normal(at.normal);
  const auto direction = [&](Vec3d v) {
    const Vec3d local = frame.to_local(v - at.position);
    return k.polygon_direction({local.x, local.y, local.z});
  };
  auto walk = k.polygon_begin();
  for (std::size_t c = 0; c + 1 < light.contours.size(); ++c)
    for (std::size_t i = light.contours[c], end = light.contours[c + 1], last = end - 1; i < end; last = i++)
      walk = k.polygon_add_edge(walk, direction(light.vertices[last]), direction(light.vertices[i]));
  const Vec3d v = frame.to_local(at.view);
  const auto e = k.polygon_irradiance_vector(walk, Mask<double>(light.side_of(at.position) < 0));
  return k.lambert_irradiance_below(e, {v.x, v.y, v.z}, loss).v / std::numbers::pi;
}

// Measures the errors over random squares (random_squares.h).
inline DiffuseBelowErrors measure_diffuse_below(double side, double degrees, int lights, std::uint64_t seed) {
  Random random(seed);
  const ShadingPoint at = seen_from(degrees);
  Material lambert;
  lambert.fresnel_loss = 1;  // F90 = 1
  RelativeRms ours, constant;
  for (int i = 0; i < lights; ++i) {
    const PreparedPolygon light = random_square(random, side);
    const double truth = reference_radiance(light, at, lambert, {1e-5, 1e-9, 100'000}).radiance.x;
    ours.add(diffuse_below(light, at, 1), truth);
    constant.add(diffuse_below(light, at, 0), truth);
  }
  return {ours.value(), constant.value()};
}

}  // namespace steradian::reference
