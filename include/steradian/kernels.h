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

#include "lambert.glsl"

#include "phong.glsl"

#include "microfacet.glsl"

#include "plane.glsl"
};

STERADIAN_END_ISA
