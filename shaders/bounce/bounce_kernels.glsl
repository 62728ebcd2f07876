// Kernels that the bounce calls, each after the ones that it needs.
// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.
#include "prelude/prelude.glsl"

#include "math/constants.glsl"
#include "math/complex.glsl"
#include "math/frame.glsl"
#include "math/gauss_legendre.glsl"
#include "math/inverse_trig.glsl"
#include "math/quartic.glsl"

#include "outline/polygon.glsl"
#include "outline/light_elements.glsl"
#include "outline/horizon_clip.glsl"

#include "lobe/lambert.glsl"
#include "lobe/microfacet.glsl"

#include "integral/ltc.glsl"

#include "indirect/indirect.glsl"
