// PassedRays: the ways of a tile's camera rays beyond surfaces that let light through. Thin walls and blended surfaces leave a ray
// straight; solids bend it where it enters and where it leaves.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "render/surface/camera_rays.h"
#include "render/surface/gbuffer.h"

namespace steradian {

class PassedRays {
 public:
  // The radiance that rays of a unit direction show that leave the scene.
  using Background = std::function<Vec3f(Vec3f direction)>;
  // Scene, rays and shading must outlive this object. background: empty: black.
  PassedRays(const Scene& scene, const RayScene& rays, const HitShading& shading, Background background);

  // Rays of one tile.
  struct Ways {
    TileVector shares;                             // fraction of the light that reaches the camera
    TilePlane behind;                              // of straight rays: distance that they have passed; 0: none goes on
    std::array<std::uint8_t, kTilePixels> bent{};  // 1: the ray no longer is that of the camera
    TileVector origin, direction;                  // of bent rays
    TilePlane length;                              // of bent rays: way from the camera to the origin
  };
  // The camera's rays up to their first surfaces.
  static void begin(const TilePlane& distances, Ways& ways);
  // Moves all rays past a tile's surfaces. Those that hold less than 1e-3 of the light end.
  void look_through(const SurfaceTile& tile, Ways& ways) const;
  // Adds the surfaces that bent rays meet to a tile without surfaces in their slots. hidden: lamps and the background are black.
  enum class Lamps { shown, hidden };
  void fill(const Ways& ways, Lamps lamps, SurfaceTile& tile) const;

 private:
  struct Ray {
    Vec3f origin, direction, weight;
    float length = 0;
  };
  void pass_solid(Ray& ray) const;

  const Scene& scene_;
  const RayScene& rays_;
  const HitShading& shading_;
  const Background background_;
  const float pixel_;  // size of a pixel at distance 1
};

}  // namespace steradian
