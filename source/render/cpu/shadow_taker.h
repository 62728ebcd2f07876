// ShadowTaker: who lights surfaces past blockers in the host's place, another back end.
#pragma once

#include <cstdint>
#include <vector>

#include "render/cpu/shadow_side.h"
#include "render/cpu/shadow_tile.h"
#include "shadow/edge_arrays.h"

namespace steradian {

class ShadowTaker {
 public:
  virtual ~ShadowTaker() = default;
  // Whether it lights points by this light, which it then takes.
  virtual bool lights(const PackLight& light) const = 0;
  // Whether it finds what a group of points sees of a flat light behind these edges, among which is no triangle that crosses the light's
  // plane. Such points are Seen::elsewhere. points: by slot. The side stays. shares: of a light, for which the outline stands: what
  // counts is the share of the outline's light that a part sends.
  virtual bool find(const LightSide& side, bool shares, const shadow::EdgeArrays& edges, const std::vector<std::uint32_t>& slots,
                    const std::vector<shadow::Viewpoint>& points) = 0;
  // How the light reaches the tile; after find() for its groups.
  virtual void take(const PackLight& light, const TileShadow& shadow) = 0;
};

}  // namespace steradian
