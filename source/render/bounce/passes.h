// Passes of a picture's bounce that a device may run in place of the packs.
#pragma once

#include <vector>

#include "render/bounce/light_sets.h"
#include "render/bounce/receivers/receivers.h"
#include "steradian/render.h"

namespace steradian::indirect {

struct BounceSettings {
  IndirectMode mode = IndirectMode::ltc;
  bool quads = true;
  bool filter = true;
};

class Passes {
 public:
  virtual ~Passes() = default;
  // Intersects the shadow map's rays; null: RayScene does.
  virtual FirstHits* first_hits() = 0;
  // The same as VirtualLightTable::prepare.
  virtual LobeArrays lobes(const ShadowMap& map) = 0;
  // Culling, lighting, filter and resolve. Returns the bounce's radiance as planes of the surfaces' raster.
  virtual VectorArray radiance(const PictureSurfaces& surfaces, const std::vector<LightSet>& sets, const Layout& layout,
                               const BounceSettings& settings) = 0;
  // Times since the last call, by the device's own clock: all these passes, and the transfers to the device and back.
  virtual std::vector<PassTime> take_times() = 0;
};

}  // namespace steradian::indirect
