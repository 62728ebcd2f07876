// ShadowTaker: another back end that lights surfaces behind occluders in place of the host.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/shadow/side.h"
#include "render/shadow/tile.h"
#include "shadow/edges/gather.h"

namespace steradian {

class ShadowTaker {
 public:
  virtual ~ShadowTaker() = default;
  // The side of a light that a slot sees, or null. It may be one side for all slots that stays valid, or be valid for sixteen calls.
  using SideAt = std::function<const LightSide*(std::uint32_t slot)>;
  // Points under an area light.
  struct Group {
    const shadow::EdgeMesh& mesh;                // the triangles that may occlude it
    const shadow::Shaft& shaft;                  // of the points and the light
    const std::vector<std::uint32_t>& crossing;  // triangles that may cross the light's plane between them
    const shadow::LightFrame& frame;             // of the edges' coordinates
    bool turned;                                 // each point sees a side of its own, in another frame
    const void* key;                             // two groups with the same key have the same frame
    bool shares;                                 // a part counts as a fraction of the light of its whole outline
    const std::vector<std::uint32_t>& slots;
    const std::vector<shadow::Viewpoint>& points;  // by slot
    const SideAt& side_at;
  };
  // Returns true if it computes the visibility of these points. They are Seen::elsewhere then.
  virtual bool find(const Group& group) = 0;
  // Takes the slots that see all of the light, which are Seen::elsewhere then. Called after find() for the tile's groups.
  virtual void take(const PackLight& light, TileShadow& shadow) = 0;
};

}  // namespace steradian
