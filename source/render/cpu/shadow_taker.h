// ShadowTaker: who lights surfaces past blockers in the host's place, another back end.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/cpu/shadow_side.h"
#include "render/cpu/shadow_tile.h"
#include "shadow/edge_arrays.h"

namespace steradian {

class ShadowTaker {
 public:
  virtual ~ShadowTaker() = default;
  // The side of a light that a slot sees, or null. It may be the same for all and stay, or be valid for sixteen calls.
  using SideAt = std::function<const LightSide*(std::uint32_t slot)>;
  // Points before an area light, and what stands between.
  struct Group {
    const shadow::EdgeArrays& edges;
    const shadow::LightFrame* base;  // in whose coordinates they are, where each point sees a side of its own; else null
    bool shares;                     // of the outline's light count: what share of it a part sends
    const std::vector<std::uint32_t>& slots;
    const std::vector<shadow::Viewpoint>& points;  // by slot
    const SideAt& side_at;
  };
  // Whether it finds what they see. They are Seen::elsewhere then.
  virtual bool find(const Group& group) = 0;
  // How the light reaches the tile; after find() for its groups.
  virtual void take(const PackLight& light, const TileShadow& shadow) = 0;
};

}  // namespace steradian
