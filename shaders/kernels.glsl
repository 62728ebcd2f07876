// Kernels that the shaders call, each after the ones that it needs.
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
#include "outline/conic.glsl"
#include "outline/ellipse.glsl"
#include "outline/capsule.glsl"
#include "outline/ellipsoid.glsl"
#include "outline/horizon_clip.glsl"
#include "outline/punctual.glsl"

#include "lobe/charlie.glsl"
#include "lobe/lambert.glsl"
#include "lobe/microfacet.glsl"
#include "lobe/phong.glsl"

#include "integral/charlie_cubature.glsl"
#include "integral/ggx_closed_form.glsl"
#include "integral/ggx_cubature.glsl"
#include "integral/ltc.glsl"
#include "integral/ltc_texture.glsl"
#include "integral/moment.glsl"
#include "integral/moment_quadrature.glsl"
#include "integral/moment_series.glsl"
#include "integral/moment_cosine.glsl"
#include "integral/half_vector.glsl"

#include "comparison/ltc_clipless.glsl"
#include "comparison/representative_point.glsl"
