// Kernels<S>: every integral of kernels/*.glsl, compiled as C++ for the number type S.
//
//   steradian::Kernels<double> k;                       // the oracle
//   auto w = k.polygon_begin();                         // walk a polygon edge by edge, in walk order
//   w = k.polygon_add_edge(w, a, b); ...
//   double irradiance = k.polygon_irradiance(w).v;
//
// The kernels are the manual: each function's comment gives frame, units, preconditions, degenerate case, error and
// source. The object has no state; making one costs nothing.
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

  // 24 where float accuracy is all that S carries, 53 for double: kernels choose their polynomials by it.
  static constexpr int real_digits() { return RealTraits<S>::kDigits; }

#include "inverse_trig.glsl"

#include "frame.glsl"

#include "polygon.glsl"

#include "ellipsoid.glsl"

#include "horizon_clip.glsl"

#include "lambert.glsl"

#include "phong.glsl"

#include "moment.glsl"

#include "moment_quadrature.glsl"

#include "moment_series.glsl"

#include "moment_cosine.glsl"

#include "moment_arvo.glsl"

#include "moment_peak_fits.glsl"

#include "lobe_product.glsl"

#include "microfacet.glsl"

#include "ltc.glsl"

#include "ltc_texture.glsl"

#include "ltc_clipless.glsl"

#include "representative_point.glsl"

#include "complex.glsl"

#include "gauss_legendre.glsl"

#include "quartic.glsl"

#include "conic.glsl"

#include "ggx_closed_form.glsl"

#include "ggx_cubature.glsl"

#include "half_vector.glsl"

#include "ellipse.glsl"

#include "capsule.glsl"

#include "indirect.glsl"

#include "plane.glsl"

// Kernels of your own, in the same dialect: define this as the file's name, and STERADIAN_ISA as a namespace of your own.
#ifdef STERADIAN_KERNEL_EXTENSION
#include STERADIAN_KERNEL_EXTENSION
#endif
};

STERADIAN_END_ISA
