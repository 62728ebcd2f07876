// Lobes of a pack of surfaces, from the compact table.
#pragma once

#include "render/direct/ltc_tables.h"
#include "render/direct/table_pack.h"

STERADIAN_BEGIN_ISA

struct SeenLobe {
  PackKernels::mat3 frame;  // x along the view, z the normal
  PackVec3 view;            // in the frame
  PackKernels::LtcMatrix matrix;
  PackReal n_a, f_a;
};

// The table's magnitude for a surface, without a matrix: for values that are multiplied by the lobe's mean Fresnel.
STERADIAN_INLINE PackKernels::vec4 look_up_magnitude(const LtcPackTables& tables, PackReal roughness, PackReal cosine) {
  const auto at = PackKernels{}.ltc_coordinates(roughness, cosine);
  return look_up(tables.magnitude.nodes.data(), tables.magnitude.size, at.x, at.y);
}

STERADIAN_INLINE SeenLobe look_up_lobe(const LtcPackTables& tables, const PackVec3& normal, const PackVec3& view, PackReal alpha) {
  PackKernels k;
  SeenLobe lobe;
  lobe.frame = k.frame_from_normal_and_view(normal, view);
  const PackReal c = dot(normal, view), roughness = sqrt(alpha);
  lobe.view = PackVec3(dot(lobe.frame.c0, view), PackReal(0.0), c);
  const auto at = k.ltc_coordinates(roughness, c);
  const auto shape = look_up(tables.matrix.nodes.data(), tables.matrix.size, at.x, at.y);
  lobe.matrix = k.ltc_from_compact(shape, max(alpha, PackReal(1.0e-4)), lobe.view);
  const auto magnitude = look_up(tables.magnitude.nodes.data(), tables.magnitude.size, at.x, at.y);
  lobe.n_a = magnitude.x;
  lobe.f_a = magnitude.y;
  return lobe;
}

STERADIAN_END_ISA
