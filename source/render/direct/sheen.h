// Sheen of cloth from area lights at many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian {

struct SheenTable {
  // Radiance of Charlie's lobe towards the views, for radiance 1. The lobe has colour 1 and width points.alpha_x.
  void (*radiance)(const PackLight& light, const Points& points, float* result);
};

STERADIAN_DECLARE_PACK_TABLE(SheenTable, sheen_table)

}  // namespace steradian
