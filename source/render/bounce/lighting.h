// Lighting: the pairs of a tile's receivers and the virtual lights on their lists.
#pragma once

#include "render/bounce/cull.h"

namespace steradian::indirect {

// A light of the set for each of a block's receivers: its index among the diffuse lights, or, after these, among the glossy ones; -1 if no
// light arrives.
struct PickedLights {
  float* diffuse;  // for the receiver's diffuse lobe
  float* glossy;
};

struct LightingTable {
  // Overwrites `light` at the block's receivers.
  void (*ltc)(const LightSet& set, BlockLists::List diffuse, BlockLists::List glossy, const Receivers& receivers, std::size_t first,
              const LtcPackTables& tables, bool quads, IncomingLight& light);
  // Algorithm 1: a virtual light's lobe is looked up for every pair. Lights are points.
  void (*ltc_outgoing)(const LightSet& set, BlockLists::List diffuse, BlockLists::List glossy, const Receivers& receivers,
                       std::size_t first, const LtcPackTables& tables, bool quads, IncomingLight& light);
  void (*ggx)(const LightSet& set, BlockLists::List diffuse, BlockLists::List glossy, const Receivers& receivers, std::size_t first,
              const LtcPackTables& tables, bool quads, IncomingLight& light);
  // Chooses lights with a probability proportional to their light by `ltc`. shares: a uniform number per receiver.
  void (*pick)(const LightSet& set, BlockLists::List diffuse, BlockLists::List glossy, const Receivers& receivers, std::size_t first,
               const LtcPackTables& tables, bool quads, const float* shares, const PickedLights& picked);
};

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::LightingTable, lighting_table)
}
