// The passes of a picture's bounce that a device may do in the place of the packs.
#pragma once

#include <vector>

#include "render/indirect/light_sets.h"
#include "render/indirect/receivers.h"
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
  // What the shadow map's rays meet; null: RayScene finds it.
  virtual FirstHits* first_hits() = 0;
  // VirtualLightTable::prepare.
  virtual LobeArrays lobes(const ShadowMap& map) = 0;
  // Culling, lighting, filter and resolve: radiance of the bounce, as planes of the surfaces' raster.
  virtual VectorArray radiance(const FrameSurfaces& surfaces, const std::vector<LightSet>& sets, const Layout& layout,
                               const BounceSettings& settings) = 0;
  // What the device's own clock says of all these, and the way to it and back; since the last call.
  virtual std::vector<PassTime> take_times() = 0;
};

}  // namespace steradian::indirect
