// EnvironmentLight: an environment prepared for a scene. Bright spots become polygon lights. Spherical harmonics of the rest light the
// diffuse lobe, and a few cones of a blurred map light all other lobes. The rest casts no shadows.
#pragma once

#include "render/environment/bright_spots.h"
#include "render/environment/direction_grid.h"
#include "render/environment/filtered_map.h"
#include "render/environment/harmonics.h"
#include "render/surface/surface.h"

namespace steradian::environment {

class EnvironmentLight {
 public:
  explicit EnvironmentLight(const Scene& scene);  // scene.environment must exist and outlive this object

  const std::vector<AreaLight>& spots() const { return spots_; }
  double share_of_spots() const { return share_; }
  // Error of the cones: rms of the difference from the sum over the texels of the rest (luminance), for GGX of roughness 0.3, 0.6 and 1. It
  // is relative to the mean of the light of the whole map.
  double specular_residual() const { return specular_residual_; }
  double diffuse_residual() const { return harmonics_.residual(); }
  const EnvironmentSampler& sampler() const { return sampler_; }

  // Radiance that a camera sees past all meshes.
  Vec3f background(Vec3f direction) const { return radiance_from(environment_.map, static_cast<Vec3d>(direction)); }

  // Radiance that a surface reflects to a unit view, without the spots.
  Vec3f reflected(const Surface& surface, Vec3f view) const;

 private:
  EnvironmentLight(const Scene& scene, const DirectionGrid& grid);
  EnvironmentLight(const Scene& scene, const DirectionGrid& grid, const SplitMap& split);
  Vec3d diffuse(const Material& lobe, Vec3d normal, Vec3d view) const;
  struct GgxSums;
  GgxSums ggx_through_cones(const Frame& frame, Vec3f view, float ax, float ay) const;
  double measured_residual(const DirectionGrid& whole, const DirectionGrid& rest) const;
  Vec3d through_cones(const Material& lobe, const Surface& surface, Vec3d normal, Vec3d view) const;

  const Environment& environment_;
  std::vector<AreaLight> spots_;
  double share_ = 0, specular_residual_ = 0;
  HarmonicIrradiance harmonics_;
  FilteredMap filtered_;
  EnvironmentSampler sampler_;  // samples the whole map
};

// Mean over the sky of Schlick's (1 - v.h)^5, weighted by the cosine: the loss of a Lambertian surface to the boundary above it.
double mean_grazing(double cos_view);

}  // namespace steradian::environment
