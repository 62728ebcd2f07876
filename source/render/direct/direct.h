// Direct light of a tile on packs: the diffuse lobe exactly, by boundary integrals.
#pragma once

#include <cstddef>

#include "core/simd.h"
#include "render/direct/closed_form.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"

namespace steradian {

struct DirectTable {
  // Adds albedo / pi times the irradiance of the lights to tile.radiance.
  void (*add_diffuse)(SurfaceTile& tile, const PackLight* const* lights, std::size_t light_count);
  // GGX radiance towards the views under a punctual light of intensity 1; see ClosedFormTable for plain and fresnel.
  void (*punctual_ggx)(const PackLight& light, const Points& points, float* plain, float* fresnel);
};

STERADIAN_DECLARE_PACK_TABLE(DirectTable, direct_table)

}  // namespace steradian
