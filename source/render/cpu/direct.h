// Direct light of a tile on packs: the diffuse lobe exactly, by boundary integrals.
#pragma once

#include <cstddef>

#include "core/simd.h"
#include "render/cpu/light_list.h"
#include "render/cpu/tile.h"

namespace steradian {

struct DirectTable {
  // Adds albedo / pi times the irradiance of the lights to tile.radiance.
  void (*add_diffuse)(SurfaceTile& tile, const PackLight* const* lights, std::size_t light_count);
};

STERADIAN_DECLARE_PACK_TABLE(DirectTable, direct_table)

}  // namespace steradian
