// Virtual lights: the lobe that each texel of a shadow map emits, with one table look-up each.
#pragma once

#include <vector>

#include "core/simd.h"
#include "render/bounce/shadow_map.h"
#include "render/direct/ltc_tables.h"

namespace steradian::indirect {

// Lobes of surfaces, for kernels/indirect/indirect.glsl. Arrays of a multiple of 16.
struct LobeArrays {
  VectorArray x, y, z;  // rows of M^-1 in world space
  FloatArray scale;     // |M^-1| / pi
  FloatArray n_a, f_a;
  FloatArray stretch;  // largest stretch of M

  explicit LobeArrays(std::size_t size = 0) : x(size), y(size), z(size), scale(size), n_a(size), f_a(size), stretch(size) {}
};

struct VirtualLightTable {
  // Algorithm 2 of Xia et al. 2023: the lobe of each texel for its incoming light, to be evaluated towards the receivers. Rows are negated.
  // The arrays are as long as the map's.
  void (*prepare)(const ShadowMap& map, const LtcPackTables& tables, LobeArrays& lobes);
};

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::VirtualLightTable, virtual_light_table)
}
