// TintedShadows: direct light past opaque occluders and through clear ones.
//
// A clear mesh is taken for opaque once. The light that it then blocks comes through it, multiplied by the fraction that it passes. So its
// shadow is as exact as that of an opaque mesh. Where several clear meshes of different colours block one light, their absorbed fractions
// add up.
#pragma once

#include <memory>
#include <vector>

#include "render/frame/tile_lighting.h"
#include "render/surface/clear_meshes.h"

namespace steradian {

class TintedShadows {
 public:
  // All arguments must outlive this object, as for TileLighting. There are no tinted shadows without shadows.
  TintedShadows(const Scene& scene, const RenderOptions& options, const DirectMethod& method, const std::vector<PackLight>& lights,
                ManyLightPass* many_lights);
  ~TintedShadows();

  // Adds direct light to a tile: add(lighting) adds it past the occluders that a TileLighting knows.
  template <class Add>
  void add(SurfaceTile& tile, TileLighting& opaque, Add add) const {
    if (groups_.empty()) return add(opaque);
    const auto sums = std::make_unique<Sums>();
    sums->before = tile.radiance;
    clear(tile.radiance);
    add(opaque);
    sums->light = sums->arrives = tile.radiance;
    for (const std::unique_ptr<Group>& group : groups_) {
      clear(tile.radiance);
      add(lighting_of(*group));
      absorb(*group, tile.radiance, *sums);
    }
    put_sum(*sums, tile.radiance);
  }

 private:
  struct Group;  // clear meshes that pass the same fraction
  struct Sums {
    TileVector before, light, arrives;
  };
  static void clear(TileVector& v);
  static TileLighting& lighting_of(Group& group);
  static void absorb(const Group& group, const TileVector& past_all, Sums& sums);
  static void put_sum(const Sums& sums, TileVector& radiance);

  std::vector<std::unique_ptr<Group>> groups_;
};

}  // namespace steradian
