// EnvironmentLight: an environment prepared for a scene. Bright spots become polygon lights. Spherical harmonics of the rest light the
// diffuse lobe, and a few cones of a blurred map light all other lobes. EnvironmentShadows is the rest past the meshes.
#pragma once

#include <array>

#include "render/environment/bright_spots.h"
#include "render/environment/direction_grid.h"
#include "render/environment/filtered_map.h"
#include "render/environment/harmonics.h"
#include "render/surface/surface.h"

namespace steradian::environment {

// A cone of directions, and the radiance that a lobe reflects from it to the view.
struct LobeCone {
  Vec3f axis;  // unit, in the world
  Vec3f reflected;
};

// The cones of one lobe.
struct LobeCones {
  static constexpr int kFew = 32;    // cones of the whole map; EnvironmentRender.SpecularAgreesWithTheReference measures their error
  static constexpr int kMost = 128;  // cones past meshes, where each has one ray
  std::array<LobeCone, kMost> cones;
  std::size_t count = 0;
  void add(Vec3f axis, Vec3f reflected) { cones[count++] = {axis, reflected}; }
  Vec3f sum() const;
};

class EnvironmentLight {
 public:
  // scene.environment must exist, and outlive this object as the table must. fitted: as lobes_of.
  explicit EnvironmentLight(const Scene& scene, const ClassicTable* fitted = nullptr);
  const ClassicTable* fitted() const { return fitted_; }

  const std::vector<AreaLight>& spots() const { return spots_; }
  double share_of_spots() const { return share_; }
  // Error of the cones: rms of the difference from the sum over the texels of the rest (luminance), for GGX of roughness 0.3, 0.6 and 1. It
  // is relative to the mean of the light of the whole map.
  double specular_residual() const { return specular_residual_; }
  double diffuse_residual() const { return harmonics_.residual(); }
  const EnvironmentSampler& sampler() const { return sampler_; }

  // Radiance that a camera sees past all meshes.
  Vec3f background(Vec3f direction) const { return radiance_from(environment_.map, static_cast<Vec3d>(direction)); }

  // Radiance of the rest, the map without the spots, averaged over a width [rad] about a direction.
  Vec3f rest(Vec3f direction, float width) const { return filtered_.mean(direction, width); }

  // Radiance that a surface reflects to a unit view from the rest, if nothing is in its way.
  Vec3f reflected(const Surface& surface, Vec3f view) const;
  // The same for a diffuse lobe, and for any other lobe by `count` cones (kFew or kMost). turn: rotation of the cones about the lobe, in
  // turns.
  Vec3f diffuse(const SurfaceLobe& lobe, Vec3f view) const;
  LobeCones cones_of(const SurfaceLobe& lobe, const Surface& surface, Vec3f view, int count, double turn) const;

 private:
  EnvironmentLight(const Scene& scene, const ClassicTable* fitted, const DirectionGrid& grid);
  EnvironmentLight(const Scene& scene, const ClassicTable* fitted, const DirectionGrid& grid, const SplitMap& split);
  template <class Use>
  void each_ggx_cone(const Frame& frame, Vec3f view, float ax, float ay, int count, double turn, Use use) const;
  double measured_residual(const DirectionGrid& whole, const DirectionGrid& rest) const;

  const Environment& environment_;
  const ClassicTable* fitted_;
  std::vector<AreaLight> spots_;
  double share_ = 0, specular_residual_ = 0;
  HarmonicIrradiance harmonics_;
  FilteredMap filtered_;
  EnvironmentSampler sampler_;  // samples the whole map
};

// Mean over the sky of Schlick's (1 - v.h)^5, weighted by the cosine: the loss of a Lambertian surface to the boundary above it.
double mean_grazing(double cos_view);

}  // namespace steradian::environment
