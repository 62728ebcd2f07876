// One bounce of light beyond the direct light: virtual point lights, culled at random without bias. Both ends use the lobes of the
// surfaces. See docs/indirect.md.
#pragma once

namespace steradian {

// off
// ltc    lobes are linearly transformed cosines: no square root and one division a pair
// ltc_outgoing  the same lists by algorithm 1 of Xia et al. 2023: a virtual light looks its lobe up for every pair; for comparison
// ggx    the same lists and the same seeds with GGX at both ends: the baseline
// path   one-bounce path tracing with `spp` paths a pixel: slow, noisy, unbiased; for comparison
enum class IndirectMode { off, ltc, ltc_outgoing, ggx, path };

struct IndirectOptions {
  IndirectMode mode = IndirectMode::off;
  int virtual_lights = 1 << 18;  // approximate: each light has a square grid of them, by its power
  int shadow_rays = 0;           // of the bounce, a pixel: 0 off, else a ratio estimator with so many rays
  double kept_pairs = 48;        // virtual lights that a pixel keeps of its fraction, on average; 0: no culling
  int interleave = 8;            // side of the pattern in which pixels share the virtual lights: 1, 2, 4 or 8
  bool filter = true;            // over the pattern, along surfaces
  bool quads = true;             // ltc: receivers with alpha < 0.1 see virtual lights as quads, not as points
  bool soften = true;            // bounds the light of near virtual lights by their area
};

}  // namespace steradian
