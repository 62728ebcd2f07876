#include "indirect/cull.h"

#include "core/pack.h"

STERADIAN_BEGIN_ISA
namespace {

using indirect::Bounds;
using indirect::Box;
using indirect::kBallPlanes;
using indirect::kSpheroidPlanes;
using indirect::Passed;
using PackMask = PackKernels::mask;

// The lanes of a mask as the lowest bits of a number.
STERADIAN_INLINE unsigned bits_of(const PackMask& m) {
#if defined(__AVX512F__)
  return static_cast<unsigned>(static_cast<__mmask16>(m.m.data));
#else
  alignas(64) float lanes[kLanes];
  store(lanes, select(m, PackReal(1.0), PackReal(0.0)));
  unsigned bits = 0;
  for (std::size_t i = 0; i < kLanes; ++i) bits |= lanes[i] > 0 ? 1u << i : 0u;
  return bits;
#endif
}

// Writes the chosen lanes side by side; room for a whole pack.
STERADIAN_INLINE void store_chosen(float* to, const float* from, unsigned bits) {
#if defined(__AVX512F__)
  _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(bits), _mm512_loadu_ps(from)));
#else
  for (; bits != 0; bits &= bits - 1) *to++ = from[__builtin_ctz(bits)];
#endif
}
STERADIAN_INLINE void store_chosen(std::uint32_t* to, const std::uint32_t* from, std::size_t first, unsigned bits) {
#if defined(__AVX512F__)
  const __m512i lanes = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
  const __m512i index = from != nullptr ? _mm512_loadu_si512(from + first)
                                        : _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(first)));
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), index));
#else
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t i = first + static_cast<std::size_t>(__builtin_ctz(bits));
    *to++ = from != nullptr ? from[i] : static_cast<std::uint32_t>(i);
  }
#endif
}

// test(i): which lights of the pack that begins at i may reach the box.
template <std::size_t planes, class Test>
STERADIAN_INLINE std::size_t run(const Bounds<planes>& bounds, const Passed<planes>& passed, Test test) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < bounds.count; i += kLanes) {
    unsigned bits = bits_of(test(i));
    // What stands behind the last light is not looked at, whatever it is.
    if (bounds.count - i < kLanes) bits &= (1u << (bounds.count - i)) - 1u;
    if (bits == 0) continue;
    if (passed.plane[0] != nullptr)
      for (std::size_t p = 0; p < planes; ++p) store_chosen(passed.plane[p] + n, bounds.plane[p] + i, bits);
    store_chosen(passed.index + n, bounds.index, i, bits);
    n += static_cast<std::size_t>(__builtin_popcount(bits));
  }
  return n;
}

// A ball against a box, and the half space in front of the light.
__attribute__((flatten)) std::size_t balls(const Bounds<kBallPlanes>& bounds, const Box& box, const Passed<kBallPlanes>& passed) {
  const PackVec3 c = broadcast(box.center), h = broadcast(box.half);
  const auto& p = bounds.plane;
  return run(bounds, passed, [&](std::size_t i) {
    const auto beyond = [&](const float* center, PackReal middle, PackReal half) {
      const PackReal d = max(abs(middle - load(center + i)) - half, PackReal(0.0));
      return d * d;
    };
    const PackReal d2 = beyond(p[0], c.x, h.x) + beyond(p[1], c.y, h.y) + beyond(p[2], c.z, h.z);
    const PackVec3 n(load(p[4] + i), load(p[5] + i), load(p[6] + i));
    const PackReal highest = dot(n, c) + abs(n.x) * h.x + abs(n.y) * h.y + abs(n.z) * h.z;
    return d2 <= load(p[3] + i) && highest > load(p[7] + i);
  });
}

// The unit ball of q = g - T p against the box under T: they are apart where the plane that touches the ball below the
// box' centre keeps all of the box out.
__attribute__((flatten)) std::size_t spheroids(const Bounds<kSpheroidPlanes>& bounds, const Box& box,
                                               const Passed<kSpheroidPlanes>& passed) {
  const PackVec3 c = broadcast(box.center), h = broadcast(box.half);
  const auto& p = bounds.plane;
  return run(bounds, passed, [&](std::size_t i) {
    const PackVec3 x(load(p[0] + i), load(p[1] + i), load(p[2] + i));
    const PackVec3 y(load(p[3] + i), load(p[4] + i), load(p[5] + i));
    const PackVec3 z(load(p[6] + i), load(p[7] + i), load(p[8] + i));
    const PackVec3 q(load(p[9] + i) - dot(x, c), load(p[10] + i) - dot(y, c), load(p[11] + i) - dot(z, c));
    const PackReal q2 = dot(q, q);
    const PackVec3 axis = x * q.x + y * q.y + z * q.z;  // T transposed times q
    const PackReal gap = q2 - (abs(axis.x) * h.x + abs(axis.y) * h.y + abs(axis.z) * h.z);
    return !(gap > PackReal(0.0) && gap * gap > q2);
  });
}

}  // namespace

const indirect::CullTable& cull_table() {
  static constexpr indirect::CullTable table = {balls, spheroids};
  return table;
}

STERADIAN_END_ISA
