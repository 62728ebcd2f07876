// Ground truth: adaptive quadrature with an error bound, and Monte Carlo with a standard error, for every lobe.
#pragma once

#include <cstdint>
#include <functional>

#include "steradian/material.h"
#include "steradian/polygon_light.h"
#include "steradian/shading_point.h"

namespace steradian {

struct ReferenceOptions {
  double relative_error = 1e-10;  // stop when the bound is below this fraction of the value ...
  double absolute_error = 1e-13;  // ... or below this, for light of radiance 1
  int max_evaluations = 4'000'000;
};

struct ReferenceResult {
  Vec3d radiance;
  double bound = 0;  // on the absolute error of the largest channel
};

// Radiance towards the view: the integral over the light of radiance times lobe, by adaptive cubature in double.
// 0 for a view below the surface and a light without area.
ReferenceResult reference_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                                   const ReferenceOptions& options = {});

// Factor on a light's radiance, by the unit direction from the point to the light. Empty: 1.
using EmissionFactor = std::function<double(Vec3d)>;

struct SampledOptions {
  int spp = 256;  // pairs of a light sample and a lobe sample
  std::uint64_t seed = 1;
  EmissionFactor emission{};
};

struct SampledResult {
  Vec3d radiance;
  double standard_error = 0;  // of the largest channel
};

// The same by Monte Carlo: light and lobe sampling, balance heuristic. Same seed, same result.
SampledResult sampled_radiance(const PreparedPolygon& light, const ShadingPoint& at, const Material& material,
                               const SampledOptions& options = {});

}  // namespace steradian
