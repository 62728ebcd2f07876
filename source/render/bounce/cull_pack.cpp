#include "render/bounce/cull.h"

#include "core/pack_bits.h"

STERADIAN_BEGIN_ISA
namespace {

using indirect::Bounds;
using indirect::kEggPlanes;
using indirect::kSpheroidPlanes;
using indirect::Passed;
using indirect::ReceiverBounds;
using PackMask = PackKernels::mask;

// Writes the chosen lanes side by side. The output needs capacity for a whole pack.
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
  const __m512i index =
      from != nullptr ? _mm512_loadu_si512(from + first) : _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(first)));
  _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), index));
#else
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t i = first + static_cast<std::size_t>(__builtin_ctz(bits));
    *to++ = from != nullptr ? from[i] : static_cast<std::uint32_t>(i);
  }
#endif
}

// test(i): returns the lights of the pack beginning at i that may reach the box.
template <std::size_t planes, class Test>
STERADIAN_INLINE std::size_t run(const Bounds<planes>& bounds, const Passed<planes>& passed, Test test) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < bounds.count; i += kLanes) {
    unsigned bits = bits_of(test(i));
    // Lanes past the last light are ignored, whatever they hold.
    if (bounds.count - i < kLanes) bits &= (1u << (bounds.count - i)) - 1u;
    if (bits == 0) continue;
    if (passed.plane[0] != nullptr)
      for (std::size_t p = 0; p < planes; ++p) store_chosen(passed.plane[p] + n, bounds.plane[p] + i, bits);
    store_chosen(passed.index + n, bounds.index, i, bits);
    n += static_cast<std::size_t>(__builtin_popcount(bits));
  }
  return n;
}

// Tests an egg against a box, by two bounds. First, d^3 <= range^2 h, with the least distance d and the greatest height h above the light's
// plane: boxes in the plane itself are culled. Second, the ball that holds the egg, which large boxes need. In addition, no light comes
// from below the horizons of all receivers: n.v is largest where each of its three products is.
__attribute__((flatten)) std::size_t eggs(const Bounds<kEggPlanes>& bounds, const ReceiverBounds& box, const Passed<kEggPlanes>& passed) {
  const PackVec3 c = broadcast(box.center), h = broadcast(box.half), m = broadcast(box.normal), w = broadcast(box.normal_half);
  const auto& p = bounds.plane;
  return run(bounds, passed, [&](std::size_t i) {
    const PackVec3 at(load(p[0] + i), load(p[1] + i), load(p[2] + i)), n(load(p[4] + i), load(p[5] + i), load(p[6] + i));
    const PackReal height = dot(n, c) + abs(n.x) * h.x + abs(n.y) * h.y + abs(n.z) * h.z - load(p[7] + i);
    const PackVec3 v = at - c;
    const auto most = [](PackReal normal, PackReal turn, PackReal way, PackReal half) {
      return normal * way + abs(normal) * half + turn * (abs(way) + half);
    };
    const PackReal above = most(m.x, w.x, v.x, h.x) + most(m.y, w.y, v.y, h.y) + most(m.z, w.z, v.z, h.z);
    const PackMask faces = height > PackReal(0.0) && above > PackReal(0.0);
    if (!any_lane(faces)) return faces;  // neighbours in the light's grid mostly agree
    const PackReal range = load(p[3] + i), range2 = range * range;
    const auto distance2 = [&](const PackVec3& from) {
      const auto beyond = [](PackReal a, PackReal middle, PackReal half) { return max(abs(middle - a) - half, PackReal(0.0)); };
      const PackVec3 d(beyond(from.x, c.x, h.x), beyond(from.y, c.y, h.y), beyond(from.z, c.z, h.z));
      return dot(d, d);
    };
    const PackReal d2 = distance2(at), reach = range2 * height;
    const PackReal ball2 = distance2(at + n * (range * broadcast(indirect::kBallCenter)));
    return faces && d2 * d2 * d2 <= reach * reach && ball2 <= range2 * broadcast(indirect::kBallRadius * indirect::kBallRadius);
  });
}

// Tests the unit ball of q = g - T p against the box under T, which is a parallelepiped. They are apart if the plane that touches the ball
// below the box' centre separates the box from it. They are also apart if the box' bounds along the lobe's axes miss the egg in the ball:
// |w|^3 <= w_z, w in units of the range. A sharp and bright lobe's ball is so large that it contains everything near its light. The egg
// begins at the light, and extends one way.
__attribute__((flatten)) std::size_t spheroids(const Bounds<kSpheroidPlanes>& bounds, const ReceiverBounds& box,
                                               const Passed<kSpheroidPlanes>& passed) {
  const PackVec3 c = broadcast(box.center), h = broadcast(box.half);
  const PackReal across = broadcast(indirect::kBallRadius), along = broadcast(indirect::kBallAlong),
                 middle = broadcast(indirect::kBallCenter);
  const auto& p = bounds.plane;
  return run(bounds, passed, [&](std::size_t i) {
    const auto reach = [&](const PackVec3& row) { return abs(row.x) * h.x + abs(row.y) * h.y + abs(row.z) * h.z; };
    const PackVec3 z(load(p[6] + i), load(p[7] + i), load(p[8] + i)), n(load(p[12] + i), load(p[13] + i), load(p[14] + i));
    const PackReal gz = load(p[11] + i), qz = gz - dot(z, c);
    const PackReal wz = along * qz + middle, deep = along * reach(z);
    const PackReal highest = wz + deep + PackReal(1.0e-6) * (abs(gz) + PackReal(1.0));  // the rounding of a difference in float
    const PackMask faces = highest > PackReal(0.0) && dot(n, c) + reach(n) > load(p[15] + i);
    if (!any_lane(faces)) return faces;
    const PackVec3 x(load(p[0] + i), load(p[1] + i), load(p[2] + i)), y(load(p[3] + i), load(p[4] + i), load(p[5] + i));
    const PackVec3 q(load(p[9] + i) - dot(x, c), load(p[10] + i) - dot(y, c), qz);
    const PackReal q2 = dot(q, q);
    const PackReal gap = q2 - reach(x * q.x + y * q.y + z * q.z);  // uses T transposed times q
    const PackVec3 least(across * max(abs(q.x) - reach(x), PackReal(0.0)), across * max(abs(q.y) - reach(y), PackReal(0.0)),
                         max(abs(wz) - deep, PackReal(0.0)));
    const PackReal w2 = dot(least, least);
    return faces && !(gap > PackReal(0.0) && gap * gap > q2) && w2 * w2 * w2 <= highest * highest;
  });
}

}  // namespace

const indirect::CullTable& cull_table() {
  static constexpr indirect::CullTable table = {eggs, spheroids};
  return table;
}

STERADIAN_END_ISA
