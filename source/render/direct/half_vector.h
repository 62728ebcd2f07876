// Microfacet lobes by arcs in half-vector space at many surface points at once, on packs.
#pragma once

#include "core/simd.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"
#include "steradian/half_vector.h"
#include "steradian/material.h"

namespace steradian {

struct HalfVectorTable {
  // GGX with shadowing, with the points' widths and tangents, for radiance 1: `plain` with F = 1, `fresnel` with F = (1 - v.h)^5.
  void (*ggx)(const PackLight& light, const Points& points, const HalfVectorOptions& options, float* plain, float* fresnel);
  // A Beckmann or Blinn-Phong lobe for radiance 1. All points have the same lobe, except for its tangent.
  void (*lobe)(const PackLight& light, const Points& points, const Material& lobe, const HalfVectorOptions& options, float* result);
};

STERADIAN_DECLARE_PACK_TABLE(HalfVectorTable, half_vector_table)

}  // namespace steradian
