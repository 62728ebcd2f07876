// Sums over all pairs of receivers and virtual lights, without culling. They measure the cost of a pair whose ends both have a diffuse and
// a glossy lobe.
#pragma once

#include <vector>

#include "render/bounce/receivers/receivers.h"
#include "render/bounce/virtual_lights.h"

namespace steradian::indirect {

// All data of a virtual light that any of the three sums reads. `glossy` is flux times the mean reflectance and the lobe's scale, or
// excludes Fresnel's grazing part if `grazing` is added.
struct PairLight {
  Vec3f position;
  Vec3f row_x, row_y, row_z, normal;  // negated
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
  // Overwrites `light` at all receivers, without adding to it, demodulated as in LightingTable.
  void (*ltc)(const PairLight* lights, std::size_t count, const Receivers& receivers, const LtcPackTables& tables, IncomingLight& light);
  void (*ltc_schlick)(const PairLight* lights, std::size_t count, const Receivers& receivers, const LtcPackTables& tables,
                      IncomingLight& light);
  // Algorithm 1: the table is looked up for every pair.
  void (*ltc_outgoing)(const GgxPairLight* lights, std::size_t count, const Receivers& receivers, const LtcPackTables& tables,
                       IncomingLight& light);
  // Overwrites with the radiance of the glossy lobe itself, Fresnel included.
  void (*ggx)(const GgxPairLight* lights, std::size_t count, const Receivers& receivers, IncomingLight& light);
};

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::PairTable, pair_table)
}
