// Sums over all pairs of receivers and virtual lights, nothing culled: what a pair costs, each end with a diffuse and a
// glossy lobe.
#pragma once

#include <vector>

#include "render/indirect/receivers.h"
#include "render/indirect/virtual_lights.h"

namespace steradian::indirect {

// All that any of the three sums reads of a virtual light. `glossy` is flux times the mean reflectance and the lobe's scale,
// or without Fresnel's grazing share where `grazing` joins it.
struct PairLight {
  Vec3f position;
  Vec3f row_x, row_y, row_z, normal;  // turned
  Vec3f diffuse, glossy;
  Vec3f grazing, incoming;
};
struct GgxPairLight {
  Vec3f position;
  Vec3f frame_x, frame_y, normal;
  float view_x, view_z, alpha;
  Vec3f diffuse, glossy, grazing;
};

struct PairTable {
  // Adds to nothing, overwrites `light` at all receivers, demodulated as in LightingTable.
  void (*ltc)(const PairLight* lights, std::size_t count, const Receivers& receivers, const LtcPackTables& tables, Light& light);
  void (*ltc_schlick)(const PairLight* lights, std::size_t count, const Receivers& receivers, const LtcPackTables& tables, Light& light);
  // Radiance of the glossy lobe as it is, Fresnel in it.
  void (*ggx)(const GgxPairLight* lights, std::size_t count, const Receivers& receivers, Light& light);
};

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::PairTable, pair_table)
}
