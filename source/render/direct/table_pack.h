// Bilinear look-up in a table of four floats a node, on packs: four loads a lane, then a transposition.
#pragma once

#include <array>
#include <cstring>

#include "core/pack.h"

STERADIAN_BEGIN_ISA

typedef float Quad __attribute__((vector_size(16)));

STERADIAN_INLINE Quad load_quad(const float* p) {
  Quad q;
  std::memcpy(&q, p, sizeof q);
  return q;
}

// nodes: size * size nodes, u along a row. u and v are in [0, 1], with nodes at both ends.
STERADIAN_INLINE PackKernels::vec4 look_up(const float* nodes, int size, PackReal u, PackReal v) {
  const PackReal last(size - 1), cells(size - 2);
  const PackReal x = clamp(u, 0.0, 1.0) * last, y = clamp(v, 0.0, 1.0) * last;
  const PackReal i = min(floor(x), cells), j = min(floor(y), cells);
  alignas(64) std::array<float, kLanes> index, fx, fy;
  store(index.data(), (j * PackReal(size) + i) * PackReal(4.0));  // exact: below 2^24
  store(fx.data(), x - i);
  store(fy.data(), y - j);
  alignas(64) std::array<std::array<float, kLanes>, 4> columns;
  const std::size_t row = static_cast<std::size_t>(size) * 4;
  for (std::size_t lane = 0; lane < kLanes; lane += 4) {
    Quad q[4];
#pragma GCC unroll 4
    for (std::size_t k = 0; k < 4; ++k) {
      const float* node = nodes + static_cast<int>(index[lane + k]);
      const float s = fx[lane + k], t = fy[lane + k];
      const Quad a = load_quad(node), b = load_quad(node + 4);
      const Quad c = load_quad(node + row), d = load_quad(node + row + 4);
      const Quad top = a + s * (b - a), bottom = c + s * (d - c);
      q[k] = top + t * (bottom - top);
    }
    const Quad xy01 = __builtin_shufflevector(q[0], q[1], 0, 4, 1, 5), xy23 = __builtin_shufflevector(q[2], q[3], 0, 4, 1, 5);
    const Quad zw01 = __builtin_shufflevector(q[0], q[1], 2, 6, 3, 7), zw23 = __builtin_shufflevector(q[2], q[3], 2, 6, 3, 7);
    const Quad out[4] = {__builtin_shufflevector(xy01, xy23, 0, 1, 4, 5), __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7),
                         __builtin_shufflevector(zw01, zw23, 0, 1, 4, 5), __builtin_shufflevector(zw01, zw23, 2, 3, 6, 7)};
    for (std::size_t c = 0; c < 4; ++c) std::memcpy(&columns[c][lane], &out[c], sizeof(Quad));
  }
  PackKernels::vec4 result;
  result.x = load(columns[0].data());
  result.y = load(columns[1].data());
  result.z = load(columns[2].data());
  result.w = load(columns[3].data());
  return result;
}

STERADIAN_END_ISA
