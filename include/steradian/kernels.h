// Kernels<S>: every integral of kernels/, compiled as C++ for the number type S.
//
//   steradian::Kernels<double> k;                       // the oracle
//   auto w = k.polygon_begin();                         // walk a polygon edge by edge, in walk order
//   w = k.polygon_add_edge(w, a, b); ...
//   double irradiance = k.polygon_irradiance(w).v;
//
// The kernels are the manual: each function's comment gives frame, units, preconditions, degenerate case, error and source. The object has
// no state; constructing one costs nothing.
#pragma once

#include "steradian/real.h"
#include "steradian/vec.h"

STERADIAN_BEGIN_ISA

template <class S>
struct Kernels {
  using real = Real<S>;
  using mask = Mask<S>;
  using vec2 = Vec2<real>;
  using vec3 = Vec3<real>;
  using vec4 = Vec4<real>;
  using mat3 = Mat3<real>;

  // 24 if S carries only float accuracy, 53 for double: kernels choose their polynomials by it.
  static constexpr int real_digits() { return RealTraits<S>::kDigits; }

// The order is that of dependency (tests/dialect_lint.py compares the list with the folders).
// clang-format off
#include "math/constants.glsl"
#include "math/complex.glsl"
#include "math/frame.glsl"
#include "math/gauss_legendre.glsl"
#include "math/inverse_trig.glsl"
#include "math/quartic.glsl"

#include "surface/surface.glsl"
#include "surface/texture.glsl"

#include "outline/polygon.glsl"
#include "outline/light_elements.glsl"
#include "outline/far_light.glsl"
#include "outline/conic.glsl"
#include "outline/ellipse.glsl"
#include "outline/capsule.glsl"
#include "outline/ellipsoid.glsl"
#include "outline/horizon_clip.glsl"
#include "outline/punctual.glsl"

#include "lobe/charlie.glsl"
#include "lobe/lambert.glsl"
#include "lobe/lobe_product.glsl"
#include "lobe/microfacet.glsl"
#include "lobe/phong.glsl"

#include "integral/charlie_cubature.glsl"
#include "integral/ggx_closed_form.glsl"
#include "integral/ggx_cubature.glsl"
#include "integral/moment.glsl"
#include "integral/moment_quadrature.glsl"
#include "integral/moment_series.glsl"
#include "integral/moment_cosine.glsl"
#include "integral/half_vector.glsl"
#include "integral/ltc.glsl"
#include "integral/ltc_texture.glsl"
#include "integral/texture_cell.glsl"

#include "comparison/ltc_clipless.glsl"
#include "comparison/moment_arvo.glsl"
#include "comparison/moment_peak_fits.glsl"
#include "comparison/representative_point.glsl"

#include "plane/plane.glsl"

#include "indirect/indirect.glsl"

#include "shadow/shadow.glsl"
// clang-format on

// Custom kernels in the same dialect: define this as the file's name, and STERADIAN_ISA as a namespace of your own.
#ifdef STERADIAN_KERNEL_EXTENSION
#include STERADIAN_KERNEL_EXTENSION
#endif
};

STERADIAN_END_ISA
