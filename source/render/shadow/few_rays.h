// FewRays: visible fractions of a light by a few rays to fixed places on it. They stand for exact shadows where time is limited.
#pragma once

#include <array>
#include <vector>

#include "render/lights/light_list.h"
#include "render/shadow/viewpoints.h"
#include "render/surface/ray_scene.h"

namespace steradian {

// Visible fraction of one light at every slot of a tile.
struct RayFractions {
  std::array<float, kTilePixels> visible;
  // Half the difference between two halves of the rays: an estimate of the error.
  std::array<float, kTilePixels> half_difference;
};

class FewRays {
 public:
  static constexpr std::size_t kMost = 64;  // rays of a point to a light
  // For `sample`: each slot takes places of its own. With the same ones, the errors of all slots would add up.
  static constexpr int kPlacesOfEach = -1;

  // All must outlive this object.
  FewRays(const RayScene& rays, const std::vector<PackLight>& lights);

  // Takes `count` rays, at most kMost, of each slot with a surface. sample: primary sample, which takes other places on the light, or
  // kPlacesOfEach.
  void find(const SurfaceTile& tile, const TilePoints& points, const PackLight& light, std::size_t count, int sample,
            RayFractions& result) const;

 private:
  struct PlaceOnLight {
    Vec3d at;
    float weight = 0;  // light of the place on the point's diffuse surface; 0: below its horizons
  };
  // A place of the sequence: itself on a flat light, else where it stands on the front of a round one.
  struct SequencePlace {
    const Vec3d* flat;  // null: the light is round
    double u, v;
  };
  SequencePlace sequence_place(const PackLight& light, std::size_t number) const;
  static PlaceOnLight place_on(const PackLight& light, const shadow::Viewpoint& from, const SequencePlace& in_sequence);

  static constexpr std::size_t kPlaces = 1024;  // places on a flat light
  const RayScene& rays_;
  std::vector<std::vector<Vec3d>> flat_;  // places on flat lights, by PackLight::index
};

}  // namespace steradian
