// Runs one case in C++, for any number type. Only for units that have the cases among their kernels (CMakeLists.txt).
#pragma once

#include <cstddef>

#include "steradian/kernels.h"

STERADIAN_BEGIN_ISA

// Case number `index` on sixteen numbers, each made a Real<S> by `make`.
template <class S, class Number, class Make>
auto run_case(std::size_t index, const Number* in, Make make) {
  Kernels<S> k;
  typename Kernels<S>::CaseInput i;
  for (auto* member : {&i.a, &i.b, &i.c, &i.d}) {
    *member = {make(in[0]), make(in[1]), make(in[2]), make(in[3])};
    in += 4;
  }
  std::size_t n = 0;
#define PARITY_CASE(name, title, measure, values, arithmetic, bound, inputs) \
  if (index == n++) return k.case_##name(i);
#include "parity_cases.inc"
#undef PARITY_CASE
  return typename Kernels<S>::vec4(make(Number(0)), make(Number(0)), make(Number(0)), make(Number(0)));
}

STERADIAN_END_ISA
