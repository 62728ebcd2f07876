// Culling and lighting of all tiles, and the visibility of the bounce.
#pragma once

#include <cstdint>

#include "render/bounce/cull.h"
#include "render/bounce/lighting.h"
#include "render/surface/ray_scene.h"

namespace steradian::indirect {

struct LightingOptions {
  IndirectMode mode = IndirectMode::ltc;
  bool quads = true;
  const RayScene* shadows = nullptr;  // null: no occlusion
  int shadow_rays = 0;
  std::uint64_t seed = 1;
};

// Thread time in milliseconds, and amount of work.
struct LightingWork {
  double cull_ms = 0, light_ms = 0, shadow_ms = 0;
  double pairs = 0;  // receivers times the lights on their block's lists
};

struct LightingResult {
  IncomingLight light;
  LightingWork work;
};

// Light at every receiver, demodulated, in the receivers' order. If the culling weights what it keeps, the mean over seeds of light_sets is
// the sum over all virtual lights of the set.
LightingResult light_receivers(const std::vector<LightSet>& sets, const Receivers& receivers, const Layout& layout,
                               const LtcPackTables& tables, const LightingOptions& options);

}  // namespace steradian::indirect
