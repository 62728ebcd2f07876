// BounceBounds: a lower and an upper bound of the light that flat diffuse surfaces send to each other (docs/bounds.md). Both are proofs:
// the light that bounces is a fixed point of a positive map, so a function that a bound of the map does not raise is above it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/certificate/factor_range.h"
#include "render/radiosity/patches.h"
#include "steradian/render.h"

namespace steradian::certificate {

// Lower and upper bounds of a radiance.
struct RadianceRange {
  Vec3d low, high;
};

class BounceBounds {
 public:
  // Throws an Error that names the first thing in the scene for which there is no proof.
  static void check(const Scene& scene, const RenderOptions& options);

  // The scene has been checked. done: called for every side whose factors are known.
  BounceBounds(const Scene& scene, const RayScene& rays, const RenderOptions& options, const std::function<void()>& done);

  // Number of calls of `done`.
  static std::size_t steps(const Scene& scene, const RenderOptions& options);

  // The light of other surfaces that a white surface reflects at a point of the scene. normal: unit, of the side that is seen.
  RadianceRange white_at(Vec3d position, Vec3d normal) const;

  std::size_t side_count() const { return sides_.size(); }

 private:
  // A side of an element, which carries one range of radiance.
  struct BoundedSide {
    OrientedTriangle triangle;
    Vec3d albedo;
    RadianceRange radiance;
  };
  struct RowEntry {
    std::uint32_t side;
    float low, high;  // of the form factor from any point of the row's side
    bool is_open;
  };
  struct Lamp {
    OrientedTriangle triangle;
    Vec3d radiance;
  };
  // Lower and upper sums of factors times radiances.
  class RowSum;

  void add_lamps(const Scene& scene);
  void find_rows(const std::function<void()>& done);
  void solve(int bounces);
  RadianceRange reflected(std::size_t side) const;
  // The side that a point lies on.
  std::uint32_t side_at(Vec3d position, Vec3d normal) const;

  const RayScene& rays_;
  radiosity::Patches patches_;
  OccluderSet occluders_;
  std::vector<BoundedSide> sides_;
  std::vector<Lamp> lamps_;
  std::vector<std::vector<RowEntry>> rows_;
  std::vector<RadianceRange> direct_;  // by side: light of the lamps that a white surface reflects
};

}  // namespace steradian::certificate
