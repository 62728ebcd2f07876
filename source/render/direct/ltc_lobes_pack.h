// Linearly transformed cosines at packs of points, from their tables.
#pragma once

#include "integrals/ggx/ltc.h"
#include "render/direct/ltc_tables.h"
#include "render/direct/seen_light_pack.h"
#include "render/direct/table_pack.h"

STERADIAN_BEGIN_ISA

// The lobes of the tables at a pack of points, in the frame of the normal and the view.
template <class Decode>
struct LobesHere {
  using Lobe = integrals::LtcLobe<Pack>;
  const LtcPackTables& tables;
  const Decode& decode;
  PackReal roughness;
  PackKernels::mat3 frame;
  PackVec3 view;

  STERADIAN_INLINE LobesHere(const Points& points, std::size_t i, const LtcPackTables& t, const Decode& d)
      : tables(t), decode(d), roughness(sqrt(load(points.alpha_x + i))) {
    const PackVec3 n = load(points.normal, i), v = load(points.view, i);
    frame = PackKernels().frame_from_normal_and_view(n, v);
    view = PackVec3(dot(frame.c0, v), PackReal(0.0), dot(n, v));
  }
  STERADIAN_INLINE Lobe look(const PackTable& matrix, const PackTable& magnitude) const {
    const auto at = PackKernels().ltc_coordinates(roughness, view.z);
    const auto scale = look_up(magnitude.nodes.data(), magnitude.size, at.x, at.y);
    return Lobe{decode(look_up(matrix.nodes.data(), matrix.size, at.x, at.y), roughness, view), scale.x, scale.y};
  }
  bool any_fresnel() const { return tables.fresnel_matrix.size > 0; }
  STERADIAN_INLINE Lobe lobe() const { return look(tables.matrix, tables.magnitude); }
  STERADIAN_INLINE Lobe fresnel() const { return look(tables.fresnel_matrix, tables.fresnel_magnitude); }
};

// work(decode) with the decoding of the tables' entries.
template <class Work>
void with_decoding(const LtcPackTables& tables, const Work& work) {
  if (tables.compact)
    work([](const PackKernels::vec4& e, PackReal roughness, const PackVec3& view) {
      return PackKernels{}.ltc_from_compact(e, max(roughness * roughness, PackReal(1.0e-4)), view);
    });
  else
    work([](const PackKernels::vec4& t, PackReal, const PackVec3&) { return PackKernels{}.ltc_from_classic(t); });
}

STERADIAN_END_ISA
