// Lobes of a pack of surfaces, from the compact table.
#pragma once

#include <algorithm>
#include <cmath>

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

// The lobe of a virtual light towards one receiver, by algorithm 1: the table is looked up for the outgoing direction.
struct OutgoingLobe {
  PackReal lobe;     // BRDF without Fresnel times the cosine of the outgoing direction
  PackReal grazing;  // mean Fresnel is F0 + (F90 - F0) grazing
};

// out: unit, in the frame of the light's surface, z the normal. view_x, view_z: the incoming light in the same frame, y = 0.
//
// The lobe of the outgoing direction holds the cosine of the incoming one. The quotient of both cosines makes it reciprocal.
STERADIAN_INLINE OutgoingLobe look_up_outgoing(const LtcPackTables& tables, const PackVec3& out, float view_x, float view_z, float alpha) {
  PackKernels k;
  const PackReal sine2 = out.x * out.x + out.y * out.y;
  const PackReal inverse = inversesqrt(max(sine2, PackReal(1.0e-30)));
  const auto at = k.ltc_coordinates(PackReal(std::sqrt(static_cast<double>(alpha))), out.z);
  const auto shape = look_up(tables.matrix.nodes.data(), tables.matrix.size, at.x, at.y);
  const auto magnitude = look_up(tables.magnitude.nodes.data(), tables.magnitude.size, at.x, at.y);
  const auto matrix =
      k.ltc_from_compact(shape, PackReal(std::max(static_cast<double>(alpha), 1.0e-4)), PackVec3(sine2 * inverse, PackReal(0.0), out.z));
  const PackReal x(static_cast<double>(view_x));
  const PackVec3 incoming(out.x * inverse * x, -(out.y * inverse) * x, PackReal(static_cast<double>(view_z)));
  const PackReal quotient = out.z * PackReal(1 / std::max(static_cast<double>(view_z), 1.0e-6));
  OutgoingLobe result;
  result.lobe = select(out.z > PackReal(0.0), magnitude.x * k.ltc_lobe(matrix, incoming) * quotient, PackReal(0.0));
  result.grazing = magnitude.y / max(magnitude.x, PackReal(1.0e-12));
  return result;
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
