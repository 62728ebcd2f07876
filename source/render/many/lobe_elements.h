// Far lights in glossy lobes: elements replace outlines, with an error bound.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd.h"
#include "integrals/procedures.h"
#include "render/direct/ltc_tables.h"
#include "render/many/far_lights.h"
#include "render/tile/tile.h"

namespace steradian::lights {

// Sums over lights of their radiance times the lobe's response to radiance 1 (as for LobeRadiance), and bounds of the sums' errors.
struct LobeSums {
  TileVector specular, grazing, specular_error, grazing_error;
};

struct LobeElements {
  // Adds flat lights, by number, at points. The number of points is a multiple of 16, at most that of a tile. A light that needs its
  // outline at some points of a block of 16 is skipped for the whole block. Then bit b of its `left` is set for block b. GGX itself leaves
  // anisotropic points to outlines.
  //
  // tables: of linearly transformed cosines; GGX itself has none.
  // error: allowed for each light, as a fraction of the light that a white diffuse surface before it would send.
  void (*add)(const FarLights& lights, const std::uint32_t* numbers, std::size_t count, const Points& points, const LtcPackTables& tables,
              float error, LobeSums& sums, std::uint64_t* left);
};

}  // namespace steradian::lights

namespace steradian {

STERADIAN_DECLARE_PACK_TABLE(lights::LobeElements, ltc_elements)
STERADIAN_DECLARE_PACK_TABLE(lights::LobeElements, ggx_elements)

// The elements of a procedure; null: it has none.
inline const lights::LobeElements* elements_of(methods::Procedure procedure, Simd simd) {
  if (procedure == methods::Procedure::ltc) return &ltc_elements_for(simd);
  return procedure == methods::Procedure::closed_form ? &ggx_elements_for(simd) : nullptr;
}

}  // namespace steradian
