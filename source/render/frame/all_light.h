// AllLight: the light that surfaces send to each other, added to the tiles of a picture (docs/bounces.md).
#pragma once

#include <memory>
#include <vector>

#include "render/frame/frame_surfaces.h"
#include "render/radiosity/gather.h"
#include "render/radiosity/patch_light.h"
#include "render/tile/pass_clock.h"

namespace steradian {

class AllLight {
 public:
  // Solves the light of all patches. All arguments but add_direct must outlive this object.
  AllLight(const Scene& scene, const SceneParts& parts, const RenderOptions& options, const radiosity::PatchLight::AddDirect& add_direct);

  // Makes the layers "indirect" and "bounce_error".
  static void begin(Picture& picture);
  // Adds the light of other surfaces to a tile's radiance, and `weight` of it to the layers. shares: fraction that arrives; null for all.
  void add(SurfaceTile& tile, TileArea area, int sample, const TileVector* shares, float weight, Picture& picture);

  void report(int threads, RenderStats& stats, const Picture& picture) const;

 private:
  const int width_;
  double solve_ms_ = 0;
  PassClock clock_{"bounces"};
  const radiosity::PatchLight patches_;
  const radiosity::Gather gather_;
};

}  // namespace steradian
