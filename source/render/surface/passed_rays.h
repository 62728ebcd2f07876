// PassedRays: the ways of a tile's camera rays beyond surfaces that let light through. Thin walls and blended surfaces leave a ray
// straight; solids bend it where it enters and where it leaves. What a face of a solid reflects within goes on as a ray of its own. At
// rough glass the way ends at its lobe.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/random.h"
#include "render/surface/camera_rays.h"
#include "render/surface/gbuffer.h"
#include "render/surface/rough_glass.h"

namespace steradian {

inline constexpr int kMostLayers = 8;  // surfaces that let light pass one behind the other, with what lies behind them
inline constexpr int kMostTurns = 32;  // surfaces along all ways of a ray, one after another

class PassedRays {
 public:
  // The radiance that rays of a unit direction show that leave the scene.
  using Background = std::function<Vec3f(Vec3f direction)>;
  // The image in rough glass. random: a solid ends rays; pass_at_random follows them. sharp: nothing is reflected within solids, either:
  // it counts as leaving.
  enum class Rough { sharp, blurred, random };
  // Scene, rays and shading must outlive this object. background: empty: black.
  PassedRays(const Scene& scene, const RayScene& rays, const HitShading& shading, Background background, Rough rough = Rough::sharp);

  struct Ray {
    Vec3f origin, direction, weight;
    float length = 0;  // way from the camera
  };
  // Rays of one tile.
  struct Ways {
    TileVector shares;                             // fraction of the light that reaches the camera
    TilePlane behind;                              // of straight rays: distance that they have passed; 0: none goes on
    std::array<std::uint8_t, kTilePixels> bent{};  // 1: the ray no longer is that of the camera
    TileVector origin, direction;                  // of bent rays
    TilePlane length;                              // of bent rays: way from the camera to the origin
    struct LobeIn {
      std::size_t slot;
      RoughGlass::Lobe lobe;
    };
    std::vector<LobeIn> lobes;  // of rough glass, at which rays have ended
    struct Aside {
      std::size_t slot;
      Ray ray;                                    // its weight is the share
      std::optional<RoughGlass::Lobe> lobe = {};  // at which it ends already
    };
    std::vector<Aside> asides;  // rays that solids have reflected within; they wait until the others end
    int layer = 0;              // surfaces along the ray
    int turn = 0;               // surfaces along all rays
    void restart();             // from the first surfaces on
  };
  // The camera's rays up to their first surfaces.
  static void begin(const TilePlane& distances, Ways& ways);
  // Moves all rays past a tile's surfaces, or begins rays that were reflected within. Returns false where no ray is left.
  bool go_on(const SurfaceTile& tile, Ways& ways) const;
  // Moves all rays past a tile's surfaces. Those that hold less than 1e-3 of the light end.
  void look_through(const SurfaceTile& tile, Ways& ways) const;
  // Adds the surfaces that bent rays meet to a tile without surfaces in their slots. hidden: lamps and the background are black.
  enum class Lamps { shown, hidden };
  void fill(const Ways& ways, Lamps lamps, SurfaceTile& tile) const;

  // True if rays beyond a surface are random.
  bool is_random(const Surface& surface) const;
  // The ray behind a solid of rough glass, by a random facet of each face. The weight does not hold the share of the first face.
  Ray pass_at_random(const Surface& face, Vec3f view, reference::Random& random) const;
  // Light from where a ray meets nothing.
  Vec3f background(Vec3f direction) const { return background_ ? background_(direction) : Vec3f{}; }

 private:
  struct Faces {
    int count = 0;
    float widest = 0;  // alpha of the roughest
    Vec3f last;        // normal of the last one, towards the ray's end
    float within = 0;  // fraction that facets of the last one reflect within
  };
  // A ray within solids.
  struct Inner {
    Ray ray;
    std::vector<const SurfaceMaterial*> within = {};  // the innermost last
    int faces = 0;                                    // that it has met
  };
  // facet(surface, view, number of the face): the normal that bends the ray. reflected: takes what faces reflect within; null: that leaves.
  template <class Facet>
  Faces pass_solid(Inner& inner, Facet facet, std::vector<Inner>* reflected = nullptr) const;
  static void begin_aside(Ways& ways);
  static void go_along(const Ray& ray, std::size_t slot, Ways& ways);
  RoughGlass::Exit exit_of(const Ray& start, const Ray& end, const Faces& faces) const;
  Ray before_face(Vec3f position, Vec3f view, float length) const;
  void end_at_lobe(const SurfaceTile& tile, std::size_t slot, Ways& ways) const;

  const Scene& scene_;
  const RayScene& rays_;
  const HitShading& shading_;
  const Background background_;
  const float pixel_;  // size of a pixel at distance 1
  const Rough rough_;
  const std::optional<RoughGlass> rough_glass_;  // none: it shows sharp images
};

}  // namespace steradian
