// Lobes under one light at many surface points at once, on packs: one function for each procedure of the table of methods.
#pragma once

#include <cstddef>

#include "core/simd.h"
#include "integrals/procedures.h"
#include "render/direct/ltc_tables.h"
#include "render/lights/light_list.h"
#include "render/tile/tile.h"
#include "steradian/material.h"
#include "steradian/phong.h"

namespace steradian {

// The properties of a lobe and of its method that all points share. GGX and sheen have the points' widths and tangents instead.
struct PackLobe {
  Material lobe = {};
  PhongOptions options = {};              // every lobe uses the quality. Unchecked; exact Phong lobes are the quadrature with 14 nodes
  const LtcPackTables* tables = nullptr;  // for ltc and ltc_clipless
};

// Results for a light of radiance 1 and a lobe of albedo 1, one float a point. A channel of a GGX lobe is f0 (plain - fresnel) +
// f90 fresnel.
struct LobeRadiance {
  float* plain;                 // radiance towards the view with F = 1; diffuse: the irradiance in [0, pi]
  float* fresnel = nullptr;     // the same with F = (1 - v.h)^5; null: not wanted
  float* irradiance = nullptr;  // ltc: the diffuse lobe's irradiance by the same walk; null: not wanted
};

struct LobePacks {
  using Function = void (*)(const PackLight& light, const Points& points, const PackLobe& lobe, const LobeRadiance& result);

  // ltc_clipless and representative_point are isotropic and use alpha_x. Arvo's recurrence wants denormals flushed (core/float_mode.h).
  Function operator[](methods::Procedure procedure) const { return functions[static_cast<std::size_t>(procedure)]; }

  Function functions[methods::kProcedures];
  // For a punctual light of intensity 1: GGX itself, or the transformed cosines of the lobe's tables.
  Function punctual_ggx, punctual_ltc;
  // Adds albedo / pi times the irradiance of the lights to tile.radiance.
  void (*add_diffuse)(SurfaceTile& tile, const PackLight* const* lights, std::size_t light_count);
};

STERADIAN_DECLARE_PACK_TABLE(LobePacks, lobe_packs)

}  // namespace steradian
