#include "render/bounce/cull.h"

#include "core/pack_bits.h"

STERADIAN_BEGIN_ISA
namespace {

using indirect::Bounds;
using indirect::kEggPlanes;
using indirect::kSpheroidPlanes;
using indirect::Passed;
using indirect::ReceiverBounds;

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

PackKernels::IndirectBox broadcast(const ReceiverBounds& box) {
  return {broadcast(box.center), broadcast(box.half), broadcast(box.normal), broadcast(box.normal_half)};
}

__attribute__((flatten)) std::size_t eggs(const Bounds<kEggPlanes>& bounds, const ReceiverBounds& box, const Passed<kEggPlanes>& passed) {
  const auto to = broadcast(box);
  return run(bounds, passed, [&](std::size_t i) {
    const auto at = [&](std::size_t plane) { return load(bounds.plane[plane] + i); };
    return PackKernels().indirect_egg_reaches(to, {at(0), at(1), at(2)}, {at(4), at(5), at(6)}, at(3), at(7));
  });
}

__attribute__((flatten)) std::size_t spheroids(const Bounds<kSpheroidPlanes>& bounds, const ReceiverBounds& box,
                                               const Passed<kSpheroidPlanes>& passed) {
  const auto to = broadcast(box);
  return run(bounds, passed, [&](std::size_t i) {
    const auto at = [&](std::size_t plane) { return load(bounds.plane[plane] + i); };
    return PackKernels().indirect_spheroid_reaches(to, {at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)},
                                                   {at(9), at(10), at(11)}, {at(12), at(13), at(14)}, at(15));
  });
}

}  // namespace

const indirect::LightCullTable& cull_table() {
  static constexpr indirect::LightCullTable table = {eggs, spheroids};
  return table;
}

STERADIAN_END_ISA
