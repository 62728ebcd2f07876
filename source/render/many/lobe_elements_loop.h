// The loop over one light at a time against sixteen points, which all elements of lights in lobes share.
#pragma once

#include <algorithm>
#include <array>

#include "core/pack.h"
#include "render/many/lobe_elements.h"

STERADIAN_BEGIN_ISA
namespace {

STERADIAN_INLINE PackVec3 vector_at(const VectorArrays& v, std::size_t i) { return {load(v.x + i), load(v.y + i), load(v.z + i)}; }

struct SpreadLight {
  PackVec3 center, normal, reach_a, reach_b;
  PackReal area, radius, spread, deviation2, third, fourth;
  bool symmetric, two_sided;

  STERADIAN_INLINE SpreadLight(const lights::FarLights& far, std::size_t i) {
    const auto number = [i](const lights::Plane& plane) { return broadcast(plane.data()[i]); };
    const auto vector = [&](const lights::Planes& p) { return PackVec3(number(p.x), number(p.y), number(p.z)); };
    center = vector(far.center);
    normal = vector(far.normal);
    reach_a = vector(far.reach_a);
    reach_b = vector(far.reach_b);
    area = number(far.area);
    radius = number(far.radius);
    spread = number(far.spread);
    deviation2 = number(far.deviation2);
    third = number(far.third);
    fourth = number(far.fourth);
    symmetric = far.symmetric.data()[i] > 0;
    two_sided = far.two_sided.data()[i] > 0;
  }
};

struct RadianceSum {
  PackVec3 value{0.0, 0.0, 0.0}, error{0.0, 0.0, 0.0};
  STERADIAN_INLINE void add(const PackVec3& radiance, const PackReal& v, const PackReal& e) {
    value = value + radiance * v;
    error = error + radiance * e;
  }
};

STERADIAN_INLINE void add_to(TileVector& to, std::size_t i, const PackVec3& a) {
  store(to.x.data() + i, load(to.x.data() + i) + a.x);
  store(to.y.data() + i, load(to.y.data() + i) + a.y);
  store(to.z.data() + i, load(to.z.data() + i) + a.z);
}

constexpr std::size_t kBlock = 16, kPacks = kBlock / kLanes;

// lobe_at(i): the lobe of a pack of points, with these members:
//   sees                         a mask
//   answer(light, allowed)       which has `serves`, a mask
//   Sum                          of answers: add(radiance, answer), put(lobe, sums, i)
template <class LobeAt>
STERADIAN_INLINE void add_elements_of(const lights::FarLights& far, const std::uint32_t* numbers, std::size_t count, const Points& points,
                                      float error, lights::LobeSums& sums, std::uint64_t* left, LobeAt lobe_at) {
  using Lobe = decltype(lobe_at(std::size_t{}));
  for (std::size_t first = 0; first < points.count; first += kBlock) {
    Lobe at[kPacks];
    typename Lobe::Sum sum[kPacks];
    for (std::size_t k = 0; k < kPacks; ++k) at[k] = lobe_at(first + k * kLanes);
    const std::uint64_t bit = std::uint64_t{1} << first / kBlock;
    bool any = false;
    for (std::size_t k = 0; k < kPacks; ++k) any = any || any_lane(at[k].sees);
    if (!any) continue;
    for (std::size_t n = 0; n < count; ++n) {
      const SpreadLight light(far, numbers[n]);
      typename Lobe::Answer answers[kPacks];
      bool serves = true;
      for (std::size_t k = 0; k < kPacks; ++k) {
        answers[k] = at[k].answer(light, broadcast(error));
        serves = serves && all_lanes(answers[k].serves);
      }
      if (!serves) {
        left[n] |= bit;
        continue;
      }
      const PackVec3 radiance(broadcast(far.radiance.x.data()[numbers[n]]), broadcast(far.radiance.y.data()[numbers[n]]),
                              broadcast(far.radiance.z.data()[numbers[n]]));
      for (std::size_t k = 0; k < kPacks; ++k) sum[k].add(radiance, answers[k]);
    }
    for (std::size_t k = 0; k < kPacks; ++k) sum[k].put(at[k], sums, first + k * kLanes);
  }
}

}  // namespace
STERADIAN_END_ISA
