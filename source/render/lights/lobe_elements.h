// Far lights in glossy lobes: elements in the place of outlines, with a bound.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/simd.h"
#include "render/cpu/ltc_points.h"
#include "render/cpu/points.h"
#include "render/lights/far_lights.h"

namespace steradian::lights {

// Sums over lights of their radiance times what the lobe sends of radiance 1 (as of LtcSums), and how far the sums may be off.
struct LobeSums {
  TileVector specular, grazing, specular_error, grazing_error;
};

struct LobeElementTable {
  // Linearly transformed cosines. Adds flat lights, by number, at points whose count is a multiple of 16, at most that of a tile. A light
  // of which some points of a block of 16 want the outline is left out for all of them: bit b of its `left` is that of block b.
  //
  // error: allowed for each light, as a share of what a white diffuse surface before it would send.
  void (*classic)(const FarLights& lights, const std::uint32_t* numbers, std::size_t count, const Points& points,
                  const LtcPackTables& tables, float error, LobeSums& sums, std::uint64_t* left);
  void (*compact)(const FarLights& lights, const std::uint32_t* numbers, std::size_t count, const Points& points,
                  const LtcPackTables& tables, float error, LobeSums& sums, std::uint64_t* left);
};

struct GgxElementTable {
  // The same for GGX itself; anisotropic points are left to the outlines.
  void (*ggx)(const FarLights& lights, const std::uint32_t* numbers, std::size_t count, const Points& points, float error, LobeSums& sums,
              std::uint64_t* left);
};

}  // namespace steradian::lights

namespace steradian {

STERADIAN_DECLARE_PACK_TABLE(lights::LobeElementTable, lobe_element_table)
STERADIAN_DECLARE_PACK_TABLE(lights::GgxElementTable, ggx_element_table)

}  // namespace steradian
