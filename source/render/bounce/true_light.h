// Ground truth of the bounce at one receiver, in double: the sum over all virtual lights.
#pragma once

#include "core/random.h"
#include "render/bounce/virtual_lights.h"
#include "render/sampled/monte_carlo.h"
#include "render/surface/surface.h"

namespace steradian::indirect {

// Lobe that a sum evaluates.
//   ggx            GGX at both ends, Schlick's Fresnel for every pair at both
//   ltc            algorithm 2: the virtual light's lobe looked up for its incoming light; by pair below F0 0.1
//   ltc_averaged   the same with Fresnel averaged over the lobe for all
//   ltc_outgoing   algorithm 1: looked up for every pair at the outgoing direction, times cos theta_o / cos theta_i
//   ltc_outgoing_raw  the same without that factor
enum class SumLobe { ggx, ltc, ltc_averaged, ltc_outgoing, ltc_outgoing_raw };

struct SumOptions {
  SumLobe lobe = SumLobe::ggx;
  bool soften = false;
  const RayScene* shadows = nullptr;
};

// Radiance towards the unit view from all texels of the map.
Vec3d sum_virtual_lights(const ShadowMap& map, const Surface& receiver, Vec3f view, const SumOptions& options);

}  // namespace steradian::indirect
