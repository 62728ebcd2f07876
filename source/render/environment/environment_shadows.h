// EnvironmentShadows: the rest of an environment past the meshes of a scene, for sixteen neighbouring surfaces at a time.
//
// Rays of fixed directions find the visible part. A diffuse lobe takes the visible fraction of directions of the whole sphere, weighted by
// their light and their cosine. Any other lobe takes one ray a cone. Where no ray is blocked, diffuse light is exactly that of
// EnvironmentLight.
#pragma once

#include <array>
#include <vector>

#include "render/environment/environment_light.h"
#include "render/surface/clear_meshes.h"
#include "render/surface/gbuffer.h"
#include "render/surface/ray_scene.h"
#include "steradian/render.h"

namespace steradian::environment {

// Difference between two halves of the rays, summed over surfaces: an estimate of the error of all rays.
struct HalvesOfRays {
  double squares = 0;  // of half the differences of the reflected luminance
  double light = 0;    // reflected luminance
  double count = 0;
  void add(double half_difference, double luminance);
  HalvesOfRays& operator+=(const HalvesOfRays& other);
  double relative_rms() const;  // over the mean luminance
};

class EnvironmentShadows {
 public:
  static constexpr std::size_t kLanes = SixteenSurfaces::kLanes;
  using Surfaces = SixteenSurfaces;

  // All must outlive this object.
  EnvironmentShadows(const EnvironmentLight& light, const Scene& scene, const RayScene& rays, const RenderOptions& options);

  // Radiance that each surface reflects to its view. sample: number of the primary sample, which turns the directions of the rays.
  std::array<Vec3f, kLanes> reflected(const Surfaces& surfaces, int sample, HalvesOfRays& halves) const;

 private:
  struct Direction {
    Vec3f to;
    Vec3f light;  // radiance of the rest about it
  };
  struct Origins;
  struct VisibleFractions;
  using Colors = std::array<Vec3f, kLanes>;
  std::uint32_t lets_pass(const Origins& origins, const std::array<Vec3f, kLanes>& directions, std::uint32_t asked, Colors& light) const;
  void add_visible(const std::array<LobeCones, kLanes>& cones, const Origins& origins, std::array<Vec3f, kLanes>& result,
                   std::array<double, kLanes>& half_difference) const;
  VisibleFractions diffuse_fractions(const Surfaces& surfaces, const Origins& origins, std::uint32_t asked, int sample) const;

  const EnvironmentLight& light_;
  const RayScene& rays_;
  const ClearMeshes clear_;
  const Terminator terminator_;
  std::vector<std::vector<Direction>> sets_;  // directions of the whole sphere, by primary sample
};

}  // namespace steradian::environment
