// EnvironmentLight: an environment made ready for a scene. Bright spots are polygon lights; the diffuse lobe takes the rest by spherical
// harmonics, all other lobes through a few cones of a blurred map. The rest casts no shadows.
#pragma once

#include "render/environment/bright_spots.h"
#include "render/environment/environment_sampler.h"
#include "render/environment/filtered_map.h"
#include "render/environment/harmonics.h"
#include "render/cpu/surface.h"

namespace steradian::environment {

class EnvironmentLight {
 public:
  explicit EnvironmentLight(const Scene& scene);  // scene.environment is there, and stays

  const std::vector<AreaLight>& spots() const { return spots_; }
  double share_of_spots() const { return share_; }
  double diffuse_residual() const { return harmonics_.residual(); }
  const EnvironmentSampler& sampler() const { return sampler_; }

  // What a camera sees beside all meshes.
  Vec3f background(Vec3f direction) const { return radiance_from(environment_.map, static_cast<Vec3d>(direction)); }

  // Radiance that a surface sends to a unit view, of all but the spots.
  Vec3f reflected(const Surface& surface, Vec3f view) const;

 private:
  EnvironmentLight(const Scene& scene, const DirectionGrid& grid);
  EnvironmentLight(const Scene& scene, const DirectionGrid& grid, const SplitMap& split);
  Vec3d diffuse(const Material& lobe, Vec3d normal, Vec3d view) const;
  struct GgxSums;
  GgxSums ggx_through_cones(const Frame& frame, Vec3f view, float ax, float ay) const;
  Vec3d through_cones(const Material& lobe, const Surface& surface, Vec3d normal, Vec3d view) const;

  const Environment& environment_;
  std::vector<AreaLight> spots_;
  double share_ = 0;
  HarmonicIrradiance harmonics_;
  FilteredMap filtered_;
  EnvironmentSampler sampler_;  // of the whole map
};

// The mean over the sky, weighed by the cosine, of Schlick's (1 - v.h)^5: what a Lambertian surface loses to the boundary above it.
double mean_grazing(double cos_view);

}  // namespace steradian::environment
