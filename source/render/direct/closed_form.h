// GGX in closed form at many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"
#include "steradian/closed_form.h"

namespace steradian {

struct ClosedFormTable {
  // Radiance towards the views for radiance 1, with shadowing. `plain` has F = 1, `fresnel` has F = (1 - v.h)^5. A channel is f0
  // (plain - fresnel) + f90 fresnel.
  void (*ggx)(const PackLight& light, const Points& points, Quality quality, float* plain, float* fresnel);
};

STERADIAN_DECLARE_PACK_TABLE(ClosedFormTable, closed_form_table)

}  // namespace steradian
