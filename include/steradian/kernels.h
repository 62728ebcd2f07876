// Kernels<S>: every integral of kernels/, compiled as C++ for the number type S.
//
//   steradian::Kernels<double> k;                       // the oracle
//   auto w = k.polygon_begin();                         // walk a polygon edge by edge, in walk order
//   w = k.polygon_add_edge(w, a, b); ...
//   double irradiance = k.polygon_irradiance(w).v;
//
// The kernels are the manual: each function's comment gives frame, units, preconditions, degenerate case, error and source. The object has
// no state; constructing one costs nothing. The kernels are in the folder `kernels` beside this file: one include path is enough.
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
#include "kernels/math/constants.glsl"
#include "kernels/math/complex.glsl"
#include "kernels/math/frame.glsl"
#include "kernels/math/gauss_legendre.glsl"
#include "kernels/math/inverse_trig.glsl"
#include "kernels/math/quartic.glsl"

#include "kernels/surface/surface.glsl"
#include "kernels/surface/texture.glsl"

#include "kernels/outline/polygon.glsl"
#include "kernels/outline/light_elements.glsl"
#include "kernels/outline/far_light.glsl"
#include "kernels/outline/conic.glsl"
#include "kernels/outline/ellipse.glsl"
#include "kernels/outline/capsule.glsl"
#include "kernels/outline/ellipsoid.glsl"
#include "kernels/outline/horizon_clip.glsl"
#include "kernels/outline/punctual.glsl"

#include "kernels/lobe/charlie.glsl"
#include "kernels/lobe/lambert.glsl"
#include "kernels/lobe/lobe_product.glsl"
#include "kernels/lobe/microfacet.glsl"
#include "kernels/lobe/phong.glsl"

#include "kernels/integral/charlie_cubature.glsl"
#include "kernels/integral/ggx_closed_form.glsl"
#include "kernels/integral/ggx_cubature.glsl"
#include "kernels/integral/moment.glsl"
#include "kernels/integral/moment_quadrature.glsl"
#include "kernels/integral/moment_series.glsl"
#include "kernels/integral/moment_cosine.glsl"
#include "kernels/integral/half_vector.glsl"
#include "kernels/integral/ltc.glsl"
#include "kernels/integral/ltc_texture.glsl"
#include "kernels/integral/slopes.glsl"
#include "kernels/integral/texture_cell.glsl"

#include "kernels/comparison/ltc_clipless.glsl"
#include "kernels/comparison/moment_arvo.glsl"
#include "kernels/comparison/moment_peak_fits.glsl"
#include "kernels/comparison/representative_point.glsl"

#include "kernels/plane/plane.glsl"

#include "kernels/indirect/indirect.glsl"

#include "kernels/shadow/shadow.glsl"
// clang-format on

// Custom kernels in the same dialect: define this as the file's name, and STERADIAN_ISA as a namespace of your own.
#ifdef STERADIAN_KERNEL_EXTENSION
#include STERADIAN_KERNEL_EXTENSION
#endif
};

STERADIAN_END_ISA
