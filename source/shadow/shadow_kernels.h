// The kernels of this folder, added to all others.
#pragma once

#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA

template <class S>
struct ShadowKernels : Kernels<S> {
  using typename Kernels<S>::real;
  using typename Kernels<S>::mask;
  using typename Kernels<S>::vec2;
  using typename Kernels<S>::vec3;
#include "shadow/shadow.glsl"
};

STERADIAN_END_ISA
